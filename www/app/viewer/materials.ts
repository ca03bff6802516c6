/** Materials of surfaces, wireframes and points. */
import {
  type BufferAttribute,
  type BufferGeometry,
  Color,
  DoubleSide,
  DynamicDrawUsage,
  type Material,
  MeshBasicMaterial,
  MeshLambertMaterial,
  NoBlending,
  type Object3D,
  PointsMaterial,
  SRGBColorSpace,
} from "three";
import { viridis } from "../text/colormap";
import type { PaneContent } from "./viewer";

const FADING = { transparent: true, blending: NoBlending, premultipliedAlpha: true } as const;

/** The first bounds of a moving shape are not valid later. */
export function readyToMove(object: Object3D, geometry: BufferGeometry): void {
  object.frustumCulled = false;
  for (const name of ["position", "normal", "color"]) {
    (geometry.getAttribute(name) as BufferAttribute | undefined)?.setUsage(DynamicDrawUsage);
  }
}

export function isLit({ style = "smooth", outline = false }: PaneContent): boolean {
  return style === "smooth" && !outline;
}

let table: Float32Array | null = null;

/** Viridis in 256 steps, in the colour space of vertex colours. */
export function viridisTable(): Float32Array {
  if (table) return table;
  const colour = new Color();
  const steps = Array.from({ length: 256 }, (_, i) => {
    const [r, g, b] = viridis(i / 255);
    return colour.setRGB(r / 255, g / 255, b / 255, SRGBColorSpace).toArray();
  });
  table = Float32Array.from(steps.flat());
  return table;
}

export function surface(content: PaneContent): Material {
  const { style = "smooth", outline = false, fade, moves = false } = content;
  if (style === "wireframe" || outline) return wires(outline);
  const fades = fade !== null;
  const material = style === "flat" ? facets(fades) : clay(fades);
  // A wireframe is drawn in front of a surface that nearly coincides with it.
  Object.assign(material, { polygonOffset: moves, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  return material;
}

function wires(thin: boolean): Material {
  return new MeshBasicMaterial({
    vertexColors: true,
    wireframe: true,
    transparent: true,
    opacity: thin ? 0.55 : 0.7,
  });
}

/** Flat shading: every triangle has one normal. */
function facets(fades: boolean): MeshLambertMaterial {
  return new MeshLambertMaterial({
    vertexColors: true,
    flatShading: true,
    side: DoubleSide,
    forceSinglePass: true,
    ...(fades ? FADING : {}),
  });
}

/**
 * Writes opacity to the canvas instead of blending: the front surface hides the back, so a fading rim never shows
 * the far side through it.
 */
function clay(fades: boolean): MeshLambertMaterial {
  const material = new MeshLambertMaterial({
    vertexColors: true,
    side: DoubleSide,
    // One pass: with two, the back faces would show at the outline.
    forceSinglePass: true,
    ...(fades ? FADING : {}),
  });
  // Back faces at the outline would be lit from the other side and appear as dark specks.
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      "#include <normal_fragment_begin>",
      "#include <normal_fragment_begin>\nnormal = normalize( vNormal );",
    );
  };
  return material;
}

export function dots(shapes: number, points: number): PointsMaterial {
  return dot(dotSize(shapes, points));
}

/** Geometry and material of a shape: a surface, one point, or a cloud of points. */
function dotSize(shapes: number, points: number): number {
  if (points > 100) return 1.8;
  return shapes > 1 ? 3.5 : 9;
}

/** A round point, `size` CSS pixels wide. */
function dot(size: number): PointsMaterial {
  const width = size * Math.min(devicePixelRatio, 2);
  const material = new PointsMaterial({ vertexColors: true, size: width, sizeAttenuation: false });
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      "#include <clipping_planes_fragment>",
      "#include <clipping_planes_fragment>\nif ( distance( gl_PointCoord, vec2( 0.5 ) ) > 0.5 ) discard;",
    );
  };
  return material;
}
