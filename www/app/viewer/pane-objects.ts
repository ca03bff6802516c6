/** Makes the three.js objects of a pane from its content, colours and moves them, and frees them. */
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Mesh,
  type Object3D,
  Points,
  SRGBColorSpace,
} from "three";
import { colourOf, shareIn } from "../text/colormap";
import { discardEllipsoid, ellipsoidObject } from "./ellipsoid";
import { dots, isLit, readyToMove, surface, viridisTable } from "./materials";
import { writeColours, writeNormals } from "./morph";
import { drawsAlike, type Moved, type PaneContent, type Shot } from "./viewer";

export interface Pane {
  content: PaneContent;
  /** One for each shape. */
  objects: Object3D[];
  /** Ellipsoid that is drawn over each of the shapes. */
  ellipsoid: Object3D | null;
}

/** A pane with new objects, or with those of another pane of the same shapes. */
export function paneOf(content: PaneContent, former: Pane | undefined = undefined): Pane {
  return {
    content,
    objects: former?.objects ?? content.shapes.map((shape) => objectOf(content, shape)),
    ellipsoid: content.ellipsoid ? ellipsoidObject(content.ellipsoid) : null,
  };
}

/** Everything of a pane that is in the scene. */
export function partsOf({ objects, ellipsoid }: Pane): Object3D[] {
  return ellipsoid ? [...objects, ellipsoid] : objects;
}

export function discardPane({ objects, ellipsoid }: Omit<Pane, "content">): void {
  discard(objects);
  if (ellipsoid) discardEllipsoid(ellipsoid);
}

function discard(objects: Object3D[]): void {
  for (const object of objects) {
    object.removeFromParent();
    const { geometry, material } = object as Mesh;
    // The triangles are shared with other objects and must not be freed.
    geometry.setIndex(null);
    geometry.dispose();
    (material as Material).dispose();
  }
}

/** Whether the objects of one content can draw the other. */
export function sameShapes(one: PaneContent, other: PaneContent): boolean {
  return (
    drawsAlike(one, other) &&
    !one.moves &&
    one.shapes.every((shape, i) => shape === other.shapes[i])
  );
}

function objectOf(content: PaneContent, shape: Float32Array): Object3D {
  const { triangles, segments } = content;
  const geometry = new BufferGeometry();
  // Moving shapes are overwritten, so they need a copy.
  const own = content.moves ? shape.slice() : shape;
  geometry.setAttribute("position", new BufferAttribute(own, 3));
  const colours = new Float32Array((shape.length / 3) * 4);
  geometry.setAttribute("color", new BufferAttribute(colours, 4));
  let made: Object3D;
  if (triangles) {
    geometry.setIndex(indexOf(triangles));
    const normals = new Float32Array(shape.length);
    writeNormals(shape, triangles, normals);
    geometry.setAttribute("normal", new BufferAttribute(normals, 3));
    made = new Mesh(geometry, surface(content));
  } else if (segments) {
    geometry.setIndex(indexOf(segments));
    made = new LineSegments(geometry, new LineBasicMaterial({ vertexColors: true }));
  } else {
    made = new Points(geometry, dots(content.shapes.length, shape.length / 3));
  }
  if (content.moves) readyToMove(made, geometry);
  return made;
}

const indices = new WeakMap<Uint32Array, BufferAttribute>();

function indexOf(cells: Uint32Array): BufferAttribute {
  const known = indices.get(cells);
  if (known) return known;
  const index = new BufferAttribute(cells, 1);
  indices.set(cells, index);
  return index;
}

/** Writes the colour and opacity of every vertex. */
export function paint({ content, objects }: Pane, range: Shot["range"]): void {
  const colour = new Color();
  for (const object of objects) {
    const attribute = (object as Mesh).geometry.getAttribute("color") as BufferAttribute;
    for (let i = 0; i < attribute.count; i += 1) {
      const value = content.values?.[i];
      const plain = content.marks?.mask[i] === 1 ? content.marks.tint : content.tint;
      const [r, g, b] =
        range && value !== undefined
          ? colourOf(content.palette ?? "viridis", shareIn(range, value))
          : plain;
      colour.setRGB(r / 255, g / 255, b / 255, SRGBColorSpace);
      const opacity = content.fade?.[i] ?? 1;
      attribute.setXYZW(i, colour.r, colour.g, colour.b, opacity);
    }
    attribute.needsUpdate = true;
  }
}

/** Moves the only shape of a pane, with its normals and colours. */
export function move(pane: Pane, { shape, values }: Moved, range: Shot["range"]): void {
  const { content, objects } = pane;
  const object = objects[0];
  if (!object) return;
  pane.content = { ...content, shapes: [shape], values };
  const { geometry } = object as Mesh;
  const position = geometry.getAttribute("position") as BufferAttribute;
  if (position.array.length !== shape.length) return;
  position.array.set(shape);
  position.needsUpdate = true;
  const normal = geometry.getAttribute("normal") as BufferAttribute | undefined;
  if (normal && content.triangles && isLit(content)) {
    writeNormals(shape, content.triangles, normal.array as Float32Array);
    normal.needsUpdate = true;
  }
  if (!values || !range) return;
  const colour = geometry.getAttribute("color") as BufferAttribute;
  writeColours(values, range, viridisTable(), colour.array as Float32Array);
  colour.needsUpdate = true;
}
