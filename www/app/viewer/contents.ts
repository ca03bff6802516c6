/** Computes the contents of the panes of the five regions: shapes, colours, ellipsoids. Pure. */
import type { Ellipsoid, Geometry, Region, RegionShapes, Side, Sides } from "../../worker/protocol";
import { isModel, ownerOf, REGIONS } from "../state/regions";
import { isColoured, type ViewMode } from "../state/view";
import type { Palette } from "../text/colormap";
import { rimFade } from "./rim";
import { type DrawnEllipsoid, type Frame, frameOf, type PaneContent } from "./viewer";

export interface Scene {
  geometry: { a: Geometry | null; b: Geometry | null };
  /** Geometry of the compared points, if they differ from those of `geometry`. */
  compared: Sides<Geometry> | null;
  shapes: Partial<Record<Region, RegionShapes>>;
  mode: ViewMode;
  dark: boolean;
  /** Whether the rim fades out: the example heads are cut at the neck. */
  fadeRim: boolean;
  /** The map that colours the vertices; standard deviations if left out. */
  map?: { values: Partial<Record<Region, Float32Array>>; palette: Palette } | undefined;
  /** In the view Pairs: a shape, and the nearest of the other model. */
  pairs?: Partial<Record<Region, readonly [Float32Array, Float32Array]>>;
  /** Covariances of the chosen vertex. */
  ellipsoids?: Partial<Record<Region, Ellipsoid>>;
}

/** Standard deviations that a semi-axis of a drawn ellipsoid stands for. */
export const ELLIPSOID_SD = 2;

const RIM_RINGS = 5;

type Rgb = readonly [number, number, number];
const CLAY: Record<"light" | "dark", Record<Side | "both", Rgb>> = {
  light: {
    a: [173, 190, 220],
    both: [205, 182, 211],
    b: [229, 196, 164],
  },
  dark: {
    a: [146, 170, 214],
    both: [196, 164, 205],
    b: [222, 180, 138],
  },
};
/** Colours of lines, more saturated than those of surfaces. */
const INK: Record<"light" | "dark", Record<Side | "both", Rgb>> = {
  light: {
    a: [37, 99, 190],
    both: [150, 66, 158],
    b: [196, 98, 16],
  },
  dark: {
    a: [122, 170, 255],
    both: [226, 150, 232],
    b: [255, 176, 96],
  },
};

/** Colour of painted points. */
const MARK: Record<"light" | "dark", Rgb> = { light: [178, 84, 188], dark: [226, 130, 236] };

const fades = new WeakMap<Uint32Array, Float32Array | null>();

export function contentsOf(scene: Scene, regions: readonly Region[]): PaneContent[] {
  return regions.flatMap((region) => contentOf(scene, region) ?? []);
}

export function contentOf(scene: Scene, region: Region): PaneContent | null {
  const found = scene.shapes[region];
  const own = ownGeometry(scene, region);
  const pair = scene.mode === "pairs" ? scene.pairs?.[region] : undefined;
  if (pair) return pairContent(scene, region, pair);
  const current = found && geometryFor(scene, region, found.mean.length);
  // Before a comparison the models themselves are shown.
  const geometry = current ?? (isModel(region) ? own : null);
  // A canvas shows 2-D or 3-D shapes, not both: if the models differ, A.
  if (!geometry || geometry.dimension !== dimensionOf(scene)) return null;
  const shown = current && found ? found : { mean: geometry.mean, vertexSd: geometry.vertexSd };
  const surface = geometry.triangles !== null;
  const cloud = isCloud(geometry);
  const shapes = (current && found && drawnShapes(scene.mode, found, cloud)) || [shown.mean];
  const shade = scene.dark ? "dark" : "light";
  return {
    region,
    shapes,
    overlaid: cloud || geometry.segments !== null,
    triangles: geometry.triangles,
    segments: geometry.segments,
    // The rim of a selected region does not fade out.
    fade:
      scene.fadeRim && geometry.triangles && !isCompared(scene, geometry) ? fadeOf(geometry) : null,
    values: isColoured(scene.mode) ? valuesOf(scene, region, shown.vertexSd) : null,
    palette: scene.map?.palette ?? "viridis",
    ellipsoid: current ? drawnEllipsoid(scene, region) : null,
    marks: null,
    tint: (surface ? CLAY : INK)[shade][ownerOf(region)],
  };
}

/** A shape and the nearest of the other model, side by side, both coloured by how far they are apart. */
function pairContent(
  scene: Scene,
  region: Region,
  pair: readonly [Float32Array, Float32Array],
): PaneContent | null {
  const [shape] = pair;
  const drawn = drawnWith(scene, region, shape.length);
  if (!drawn) return null;
  const points = shape.length / (dimensionOf(scene) ?? 3);
  const values = scene.map?.values[region];
  return {
    ...drawn,
    shapes: [...pair],
    overlaid: false,
    values: values?.length === points ? values : null,
    palette: scene.map?.palette ?? "viridis",
    ellipsoid: null,
    marks: null,
    tint: tintOf(scene, region, drawn.triangles === null),
  };
}

/** The shapes of a region that a view draws; null for the mean alone. */
function drawnShapes(mode: ViewMode, found: RegionShapes, cloud: boolean): Float32Array[] | null {
  if (mode === "samples" || cloud) return samplesOf(found);
  return mode === "contrast" && found.contrast ? [found.contrast.shape] : null;
}

/** The geometry for a shape of a region by its number of coordinates; null if no model has as many. */
export function drawnWith(
  scene: Scene,
  region: Region,
  length: number,
): Pick<PaneContent, "region" | "triangles" | "segments" | "fade" | "overlaid"> | null {
  const geometry = geometryFor(scene, region, length);
  if (!geometry || geometry.dimension !== dimensionOf(scene)) return null;
  const { triangles, segments } = geometry;
  const cut = scene.fadeRim && triangles !== null && !isCompared(scene, geometry);
  return { region, triangles, segments, fade: cut ? fadeOf(geometry) : null, overlaid: true };
}

/** The colour of a region for surfaces or for lines. */
export function tintOf(scene: Scene, region: Region, lines: boolean): Rgb {
  return (lines ? INK : CLAY)[scene.dark ? "dark" : "light"][ownerOf(region)];
}

/** The values of a map, if it is of the drawn points. */
function valuesOf(scene: Scene, region: Region, vertexSd: Float32Array): Float32Array | null {
  if (!scene.map) return vertexSd;
  const found = scene.map.values[region];
  return found?.length === vertexSd.length ? found : null;
}

/** Colour of an ellipsoid, distinct from the colours of the maps. */
const ELLIPSOID_INK: Record<"light" | "dark", Rgb> = { light: [24, 22, 30], dark: [250, 246, 252] };

function drawnEllipsoid(scene: Scene, region: Region): DrawnEllipsoid | null {
  const found = scene.ellipsoids?.[region];
  if (!found || found.centre.length !== dimensionOf(scene)) return null;
  return {
    centre: found.centre,
    axes: found.axes.map((length) => ELLIPSOID_SD * length),
    ink: ELLIPSOID_INK[scene.dark ? "dark" : "light"],
  };
}

/** Whether a model is a few single points, whose random shapes are drawn overlaid. */
export function isCloud(geometry: Geometry): boolean {
  const points = geometry.mean.length / geometry.dimension;
  return geometry.triangles === null && geometry.segments === null && points <= 8;
}

/** Content of the picture of a model card: the mean shape. */
export function cardContent(geometry: Geometry, side: Region, scene: Scene): PaneContent | null {
  const alone = { ...scene, compared: null, shapes: {}, mode: "mean" as const };
  return contentOf({ ...alone, geometry: { a: geometry, b: geometry } }, side);
}

/** Common frame of all panes. */
export function sceneFrame(scene: Scene): Frame {
  const dimension = dimensionOf(scene) ?? 3;
  const means = contentsOf({ ...scene, mode: "mean" }, ["a", "b"]);
  const pushes = scene.mode === "contrast" || scene.mode === "pairs";
  const pushed = pushes ? contentsOf(scene, REGIONS) : [];
  const many = scene.mode === "samples" || means.some((content) => content.overlaid);
  const shown = many ? contentsOf({ ...scene, mode: "samples" }, REGIONS) : means;
  const fade = means[0]?.fade ?? null;
  return frameOf(
    [...means, ...shown, ...pushed].flatMap((content) => content.shapes),
    dimension,
    fade,
  );
}

export function dimensionOf({ geometry }: Scene): 2 | 3 | null {
  return (geometry.a ?? geometry.b)?.dimension ?? null;
}

const split = new WeakMap<RegionShapes, Float32Array[]>();

/** The single shapes of a region; the same arrays for the same shapes, so that a viewer can keep its buffers. */
function samplesOf(found: RegionShapes): Float32Array[] {
  const known = split.get(found);
  if (known) return known;
  const length = found.mean.length;
  const samples = Array.from({ length: found.count }, (_, i) =>
    found.samples.subarray(i * length, (i + 1) * length),
  ).filter((sample) => sample.length === length);
  split.set(found, samples);
  return samples;
}

export function ownGeometry(scene: Scene, region: Region): Geometry | null {
  return scene.geometry[sideOf(region)];
}

/** The model whose points a region has; for the intersection, A. */
function sideOf(region: Region): Side {
  return ownerOf(region) === "b" ? "b" : "a";
}

/** The geometry with this number of coordinates: one with triangles if possible, that of its own model first. */
function geometryFor(scene: Scene, region: Region, length: number): Geometry | null {
  const { geometry, compared } = scene;
  const both = compared ?? geometry;
  const own = both[sideOf(region)];
  const fits = [...(compared ? [own] : []), both.a, both.b].filter(
    (g) => g?.mean.length === length,
  );
  return fits.find((g) => g?.triangles || g?.segments) ?? fits[0] ?? null;
}

function isCompared({ compared }: Scene, geometry: Geometry): boolean {
  return compared !== null && (geometry === compared.a || geometry === compared.b);
}

/** Content while painting: the mean of A with the painted points marked. */
export function markedContent(scene: Scene, mask: Uint8Array): PaneContent | null {
  const content = contentOf({ ...scene, compared: null, shapes: {}, mode: "mean" }, "a");
  const shade = scene.dark ? "dark" : "light";
  return content && { ...content, marks: { mask, tint: MARK[shade] } };
}

function fadeOf(geometry: Geometry): Float32Array | null {
  const { triangles, mean, dimension } = geometry;
  if (!triangles) return null;
  const known = fades.get(triangles);
  if (known !== undefined) return known;
  const fade = rimFade(triangles, mean.length / dimension, RIM_RINGS);
  fades.set(triangles, fade);
  return fade;
}
