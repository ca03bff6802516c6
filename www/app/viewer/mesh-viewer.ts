/** Draws 3-D shapes with WebGL: one context, a scissored viewport per shape, drawn only on demand. */
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Matrix4,
  Mesh,
  type Object3D,
  PerspectiveCamera,
  Points,
  Scene,
  SRGBColorSpace,
  Vector3,
  WebGLRenderer,
} from "three";
import type { Region } from "../../worker/protocol";
import { type Camera, HOME } from "../state/camera";
import { colourOf, shareIn } from "../text/colormap";
import { discardEllipsoid, ellipsoidObject } from "./ellipsoid";
import { dots, isLit, readyToMove, surface, viridisTable } from "./materials";
import { writeColours, writeNormals } from "./morph";
import { pickVertex } from "./pick";
import { note, timesDrawing } from "./timing";
import {
  cellsOf,
  type Frame,
  type Hit,
  halfHeightIn,
  type Moved,
  type PaneContent,
  type Rect,
  type Shot,
  type Viewer,
} from "./viewer";

const FIELD_OF_VIEW = 22;
/** Largest drawing buffer that browsers guarantee; larger pictures are drawn in parts. */
const LARGEST_TILE = 2048;

interface Pane {
  content: PaneContent;
  objects: Object3D[];
  /** Ellipsoid that is drawn over each of the shapes. */
  ellipsoid: Object3D | null;
}

export class MeshViewer implements Viewer {
  #renderer: WebGLRenderer;
  #canvas: HTMLCanvasElement;
  #scene = new Scene();
  #eye = new PerspectiveCamera(FIELD_OF_VIEW);
  #sky = new HemisphereLight();
  #key = new DirectionalLight();
  #rim = new DirectionalLight();
  #panes: Pane[] = [];
  /** Objects of the last picture that is not on the canvas. */
  #last: Pane | null = null;
  #frame: Frame = { centre: [0, 0, 0], halfWidth: 1, halfHeight: 1 };
  #layout: ReadonlyMap<Region, Rect> = new Map();
  #size = { width: 1, height: 1 };
  #range: readonly [number, number] | null = null;
  #camera: Camera = HOME;
  #scheduled = 0;
  #indices = new WeakMap<Uint32Array, BufferAttribute>();

  constructor(canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
    this.#renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.#renderer.setClearAlpha(0);
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#renderer.autoClear = false;
    this.#eye.add(this.#key, this.#key.target, this.#rim, this.#rim.target);
    this.#key.position.set(-0.55, 0.75, 1);
    this.#rim.position.set(0.9, 0.5, -0.8);
    this.#scene.add(this.#eye, this.#sky);
    canvas.addEventListener("webglcontextrestored", () => this.#request());
  }

  setLayout(width: number, height: number, panes: ReadonlyMap<Region, Rect>): void {
    this.#layout = panes;
    if (width !== this.#size.width || height !== this.#size.height) {
      this.#size = { width, height };
      this.#renderer.setSize(width, height, false);
    }
    this.#request();
  }

  setMesh(panes: PaneContent[], frame: Frame): void {
    const former = this.#panes;
    this.#frame = frame;
    this.#panes = panes.map((content) => {
      const kept = former.find((pane) => sameShapes(pane.content, content));
      const objects = kept?.objects ?? this.#objectsOf(content);
      return { content, objects, ellipsoid: ellipsoidOf(content) };
    });
    for (const { ellipsoid } of former) if (ellipsoid) discardEllipsoid(ellipsoid);
    const used = new Set(this.#panes.flatMap((pane) => pane.objects));
    discard(former.flatMap((pane) => pane.objects).filter((object) => !used.has(object)));
    this.#paint();
    for (const object of used) this.#scene.add(object);
    for (const { ellipsoid } of this.#panes) if (ellipsoid) this.#scene.add(ellipsoid);
    this.#request();
  }

  morph(moved: readonly (Moved | null)[]): void {
    const begun = performance.now();
    moved.forEach((change, i) => {
      const pane = this.#panes[i];
      const object = pane?.objects[0];
      if (!change || !pane || !object) return;
      this.#move(pane, (object as Mesh).geometry, change);
    });
    this.#request();
    note("normals and colours", begun);
  }

  #move(pane: Pane, geometry: BufferGeometry, { shape, values }: Moved): void {
    const { content } = pane;
    pane.content = { ...content, shapes: [shape], values };
    const position = geometry.getAttribute("position") as BufferAttribute;
    if (position.array.length !== shape.length) return;
    position.array.set(shape);
    position.needsUpdate = true;
    const normal = geometry.getAttribute("normal") as BufferAttribute | undefined;
    if (normal && content.triangles && isLit(content)) {
      writeNormals(shape, content.triangles, normal.array as Float32Array);
      normal.needsUpdate = true;
    }
    if (!values || !this.#range) return;
    const colour = geometry.getAttribute("color") as BufferAttribute;
    writeColours(values, this.#range, viridisTable(), colour.array as Float32Array);
    colour.needsUpdate = true;
  }

  setColors(range: readonly [number, number] | null): void {
    if (range?.[0] === this.#range?.[0] && range?.[1] === this.#range?.[1]) return;
    this.#range = range;
    this.#paint();
    this.#request();
  }

  setCamera(camera: Camera): void {
    this.#camera = camera;
    this.#request();
  }

  pick(x: number, y: number): Hit | null {
    for (const { content } of this.#panes) {
      const rect = this.#layout.get(content.region);
      if (!rect || !contains(rect, x, y)) continue;
      const cells = cellsOf(rect, content.overlaid ? 1 : content.shapes.length, this.#frame);
      const index = cells.findIndex((cell) => contains(cell, x, y));
      const cell = cells[index];
      const shape = content.shapes[index];
      if (!cell || !shape) return null;
      this.#aim(cell, this.#frame);
      const matrix = new Matrix4().multiplyMatrices(
        this.#eye.projectionMatrix,
        this.#eye.matrixWorldInverse,
      );
      const { width, height } = cell;
      const at = { x: x - cell.x, y: y - cell.y, width, height };
      const hit = pickVertex(shape, 3, matrix.elements, at);
      return hit && { region: content.region, vertex: hit.vertex, shape: index };
    }
    return null;
  }

  positionOf(region: Region, point: readonly number[]): { x: number; y: number } | null {
    const cell = this.#layout.get(region);
    if (!cell) return null;
    this.#aim(cell, this.#frame);
    const { x, y } = vector(point).project(this.#eye);
    return { x: cell.x + ((x + 1) * cell.width) / 2, y: cell.y + ((1 - y) * cell.height) / 2 };
  }

  pointAt(region: Region, through: readonly number[], x: number, y: number): number[] | null {
    const cell = this.#layout.get(region);
    if (!cell) return null;
    this.#aim(cell, this.#frame);
    const position = vector(through).project(this.#eye);
    position.x = (2 * (x - cell.x)) / cell.width - 1;
    position.y = 1 - (2 * (y - cell.y)) / cell.height;
    return position.unproject(this.#eye).toArray();
  }

  capture(scale: number, shot: Shot = this.#shot()): HTMLCanvasElement {
    const copy = document.createElement("canvas");
    copy.width = Math.round(shot.width * scale);
    copy.height = Math.round(shot.height * scale);
    const pen = copy.getContext("2d");
    const [ratio, kept] = [this.#renderer.getPixelRatio(), this.#shot()];
    this.#renderer.setPixelRatio(1);
    this.#renderer.setScissorTest(false);
    [this.#camera, this.#range] = [shot.camera, shot.range];
    this.#light();
    for (const content of shot.panes) {
      const rect = shot.layout.get(content.region);
      if (!pen || !rect || rect.width < 2 || rect.height < 2) continue;
      this.#withObjects(content, scale / ratio, (pane) => {
        const cells = cellsOf(rect, pane.content.overlaid ? 1 : pane.objects.length, shot.frame);
        cells.forEach((cell, i) => {
          this.#show(pane, i);
          this.#drawTiles(pen, cell, scale, shot.frame);
        });
      });
    }
    [this.#camera, this.#range] = [kept.camera, kept.range];
    this.#eye.clearViewOffset();
    this.#renderer.setPixelRatio(ratio);
    this.#renderer.setSize(this.#size.width, this.#size.height, false);
    // Before the next repaint, once for many pictures.
    this.#request();
    return copy;
  }

  /** The panes on the canvas. */
  #shot(): Shot {
    const { width, height } = this.#size;
    return {
      width,
      height,
      layout: this.#layout,
      panes: this.#panes.map(({ content }) => content),
      frame: this.#frame,
      camera: this.#camera,
      range: this.#range,
    };
  }

  /** Objects of a content: those on the canvas, or new ones that are freed afterwards. */
  #withObjects(content: PaneContent, enlarged: number, use: (pane: Pane) => void): void {
    const shown = this.#panes.find((pane) => pane.content === content);
    const objects = shown?.objects ?? this.#objectsOf(content);
    const ellipsoid = shown?.ellipsoid ?? ellipsoidOf(content);
    const pane = { content, objects, ellipsoid };
    if (!shown) {
      this.#paintPane(pane);
      this.#scene.add(...objects, ...(ellipsoid ? [ellipsoid] : []));
    }
    const points = objects.filter((object) => object instanceof Points);
    // The size of points is in pixels, independent of the size of the picture.
    for (const { material } of points) material.size *= enlarged;
    use(pane);
    for (const { material } of points) material.size /= enlarged;
    if (shown) return;
    for (const object of [...objects, ...(ellipsoid ? [ellipsoid] : [])]) object.removeFromParent();
    this.#letGo();
    this.#last = pane;
  }

  /** Frees objects later: with the last material its shader would be freed and compiled again for every picture. */
  #letGo(): void {
    if (!this.#last) return;
    discard(this.#last.objects);
    if (this.#last.ellipsoid) discardEllipsoid(this.#last.ellipsoid);
    this.#last = null;
  }

  /** Draws one cell at its size in the picture, part by part. */
  #drawTiles(pen: CanvasRenderingContext2D, cell: Rect, scale: number, frame: Frame): void {
    const [left, top] = [Math.round(cell.x * scale), Math.round(cell.y * scale)];
    const width = Math.max(1, Math.round(cell.width * scale));
    const height = Math.max(1, Math.round(cell.height * scale));
    const tile = { width: Math.min(width, LARGEST_TILE), height: Math.min(height, LARGEST_TILE) };
    const canvas = this.#canvas;
    // Setting the size of a canvas clears it.
    if (canvas.width !== tile.width || canvas.height !== tile.height) {
      this.#renderer.setSize(tile.width, tile.height, false);
    }
    this.#renderer.setViewport(0, 0, tile.width, tile.height);
    for (let y = 0; y < height; y += tile.height) {
      for (let x = 0; x < width; x += tile.width) {
        this.#eye.clearViewOffset();
        this.#aim(cell, frame);
        this.#eye.setViewOffset(width, height, x, y, tile.width, tile.height);
        this.#renderer.clear();
        this.#renderer.render(this.#scene, this.#eye);
        const [w, h] = [Math.min(tile.width, width - x), Math.min(tile.height, height - y)];
        pen.drawImage(canvas, 0, 0, w, h, left + x, top + y, w, h);
      }
    }
  }

  thumbnail(content: PaneContent, frame: Frame, size: number): HTMLCanvasElement {
    const objects = this.#objectsOf(content);
    this.#paintPane({ content, objects, ellipsoid: null });
    this.#scene.add(...objects);
    this.#hideAll();
    for (const object of objects) object.visible = true;
    const ratio = this.#renderer.getPixelRatio();
    // Drawn on the canvas of the page, which has no size while another tab is shown.
    const stage = this.#size;
    this.#size = { width: Math.max(size, stage.width), height: Math.max(size, stage.height) };
    const resized = this.#size.width !== stage.width || this.#size.height !== stage.height;
    if (resized) this.#renderer.setSize(this.#size.width, this.#size.height, false);
    const cell = { x: 0, y: 0, width: size, height: size };
    this.#renderer.setScissorTest(false);
    this.#renderer.clear();
    const camera = this.#camera;
    this.#camera = HOME;
    this.#draw(cell, frame);
    this.#camera = camera;
    const copy = document.createElement("canvas");
    copy.width = copy.height = Math.round(size * ratio);
    copy.getContext("2d")?.drawImage(this.#canvas, 0, 0);
    discard(objects);
    this.#size = stage;
    if (resized) this.#renderer.setSize(stage.width, stage.height, false);
    this.#render();
    return copy;
  }

  dispose(): void {
    cancelAnimationFrame(this.#scheduled);
    this.#letGo();
    for (const { objects, ellipsoid } of this.#panes) {
      discard(objects);
      if (ellipsoid) discardEllipsoid(ellipsoid);
    }
    this.#renderer.dispose();
    // A page may have only a few contexts; without this the oldest one would be lost.
    this.#renderer.forceContextLoss();
  }

  #request(): void {
    if (this.#scheduled !== 0) return;
    this.#scheduled = requestAnimationFrame(() => this.#render());
  }

  #render(): void {
    const begun = performance.now();
    cancelAnimationFrame(this.#scheduled);
    this.#scheduled = 0;
    this.#renderer.setScissorTest(false);
    this.#renderer.clear();
    this.#light();
    for (const pane of this.#panes) {
      const rect = this.#layout.get(pane.content.region);
      if (!rect || rect.width < 2 || rect.height < 2) continue;
      const side = pane.content.overlaid ? 1 : pane.objects.length;
      cellsOf(rect, side, this.#frame).forEach((cell, i) => {
        this.#show(pane, i);
        this.#draw(cell, this.#frame);
      });
    }
    note("upload and draw calls", begun);
    if (timesDrawing()) this.#waitUntilDrawn();
  }

  /** Waits until the GPU has drawn, by reading a pixel. */
  #waitUntilDrawn(): void {
    const begun = performance.now();
    const context = this.#renderer.getContext();
    context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, new Uint8Array(4));
    note("until it is drawn", begun);
  }

  /** Shows only the shapes of one cell of a pane. */
  #show({ content, objects, ellipsoid }: Pane, cell: number): void {
    this.#hideAll();
    objects.forEach((object, i) => {
      object.visible = content.overlaid || i === cell;
    });
    if (ellipsoid) ellipsoid.visible = true;
  }

  #hideAll(): void {
    for (const pane of this.#panes) {
      for (const object of pane.objects) object.visible = false;
      if (pane.ellipsoid) pane.ellipsoid.visible = false;
    }
  }

  #draw(cell: Rect, frame: Frame): void {
    const bottom = this.#size.height - cell.y - cell.height;
    this.#renderer.setViewport(cell.x, bottom, cell.width, cell.height);
    this.#renderer.setScissor(cell.x, bottom, cell.width, cell.height);
    this.#renderer.setScissorTest(true);
    this.#aim(cell, frame);
    this.#renderer.render(this.#scene, this.#eye);
  }

  #aim(cell: Rect, frame: Frame): void {
    const { yaw, pitch, zoom, x, y } = this.#camera;
    const halfHeight = halfHeightIn(cell, frame) / zoom;
    const distance = halfHeight / Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
    const reach = Math.hypot(frame.halfWidth, frame.halfHeight) * 1.6;
    // The camera keeps its distance at any zoom; the field of view narrows instead.
    const away = Math.max(distance, reach * 1.5);
    const eye = this.#eye;
    eye.fov = (360 / Math.PI) * Math.atan(halfHeight / away);
    eye.aspect = cell.width / cell.height;
    eye.near = Math.max(away - reach * 1.4, away * 0.01);
    eye.far = away + reach * 1.4;
    const [cx, cy, cz] = frame.centre;
    eye.rotation.set(-pitch, yaw, 0, "YXZ");
    eye.position.set(x * frame.halfHeight, y * frame.halfHeight, away).applyEuler(eye.rotation);
    eye.position.x += cx;
    eye.position.y += cy;
    eye.position.z += cz;
    eye.updateProjectionMatrix();
    eye.updateMatrixWorld();
  }

  /** Flatter light for coloured maps. */
  #light(): void {
    const read = this.#range !== null;
    this.#sky.color.set(0xffffff);
    this.#sky.groundColor.set(read ? 0xb8b8b8 : 0x8a8177);
    this.#sky.intensity = read ? 2.5 : 1.55;
    this.#key.intensity = read ? 0.9 : 2.0;
    this.#rim.intensity = read ? 0.2 : 0.9;
  }

  #objectsOf(content: PaneContent): Object3D[] {
    const { triangles, segments } = content;
    return content.shapes.map((shape) => {
      const geometry = new BufferGeometry();
      // Moving shapes are overwritten, so they need a copy.
      const own = content.moves ? shape.slice() : shape;
      geometry.setAttribute("position", new BufferAttribute(own, 3));
      const colours = new Float32Array((shape.length / 3) * 4);
      geometry.setAttribute("color", new BufferAttribute(colours, 4));
      let made: Object3D;
      if (triangles) {
        geometry.setIndex(this.#index(triangles));
        const normals = new Float32Array(shape.length);
        writeNormals(shape, triangles, normals);
        geometry.setAttribute("normal", new BufferAttribute(normals, 3));
        made = new Mesh(geometry, surface(content));
      } else if (segments) {
        geometry.setIndex(this.#index(segments));
        made = new LineSegments(geometry, new LineBasicMaterial({ vertexColors: true }));
      } else {
        made = new Points(geometry, dots(content.shapes.length, shape.length / 3));
      }
      if (content.moves) readyToMove(made, geometry);
      return made;
    });
  }

  #index(cells: Uint32Array): BufferAttribute {
    const known = this.#indices.get(cells);
    if (known) return known;
    const index = new BufferAttribute(cells, 1);
    this.#indices.set(cells, index);
    return index;
  }

  #paint(): void {
    for (const pane of this.#panes) this.#paintPane(pane);
  }

  #paintPane({ content, objects }: Pane): void {
    const colour = new Color();
    for (const object of objects) {
      const attribute = (object as Mesh).geometry.getAttribute("color") as BufferAttribute;
      for (let i = 0; i < attribute.count; i += 1) {
        const value = content.values?.[i];
        const plain = content.marks?.mask[i] === 1 ? content.marks.tint : content.tint;
        const [r, g, b] =
          this.#range && value !== undefined
            ? colourOf(content.palette ?? "viridis", shareIn(this.#range, value))
            : plain;
        colour.setRGB(r / 255, g / 255, b / 255, SRGBColorSpace);
        const opacity = content.fade?.[i] ?? 1;
        attribute.setXYZW(i, colour.r, colour.g, colour.b, opacity);
      }
      attribute.needsUpdate = true;
    }
  }
}

function sameShapes(one: PaneContent, other: PaneContent): boolean {
  return (
    one.region === other.region &&
    one.triangles === other.triangles &&
    one.segments === other.segments &&
    one.fade === other.fade &&
    one.style === other.style &&
    one.outline === other.outline &&
    one.moves === other.moves &&
    one.shapes.length === other.shapes.length &&
    !one.moves &&
    one.shapes.every((shape, i) => shape === other.shapes[i])
  );
}

function ellipsoidOf({ ellipsoid }: PaneContent): Object3D | null {
  return ellipsoid ? ellipsoidObject(ellipsoid) : null;
}

function contains(rect: Rect, x: number, y: number): boolean {
  return x >= rect.x && y >= rect.y && x < rect.x + rect.width && y < rect.y + rect.height;
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

function vector(point: readonly number[]): Vector3 {
  return new Vector3(point[0], point[1], point[2]);
}
