/** What the panes of the regions show. Pure. */
import type { BothSides, Ellipsoid, Geometry, Region, RegionShapes } from "../../worker/protocol";
import { REGIONS, type ViewMode } from "../state/view";
import type { Palette } from "../text/colormap";
import { rimFade } from "./rim";
import { type DrawnEllipsoid, type Frame, frameOf, type PaneContent } from "./viewer";

export interface Scene {
  geometry: { a: Geometry | null; b: Geometry | null };
  /** The models as a run compares them, where those are other points than `geometry` has. */
  compared: BothSides<Geometry> | null;
  shapes: Partial<Record<Region, RegionShapes>>;
  mode: ViewMode;
  dark: boolean;
  /** Packaged heads are cut at the neck. */
  fadeRim: boolean;
  /** What is coloured onto the vertices; where this is left out, their standard deviations. */
  map?: { values: Partial<Record<Region, Float32Array>>; palette: Palette } | undefined;
  /** Covariances of the vertex that is looked at. */
  ellipsoids?: Partial<Record<Region, Ellipsoid>>;
}

/** Standard deviations to a semi-axis of an ellipsoid as it is drawn. */
export const ELLIPSOID_SD = 2;

const RIM_RINGS = 5;

type Rgb = readonly [number, number, number];
const CLAY: Record<"light" | "dark", Record<Region, Rgb>> = {
  light: {
    a: [173, 190, 220],
    aWithoutB: [173, 190, 220],
    intersection: [205, 182, 211],
    bWithoutA: [229, 196, 164],
    b: [229, 196, 164],
  },
  dark: {
    a: [146, 170, 214],
    aWithoutB: [146, 170, 214],
    intersection: [196, 164, 205],
    bWithoutA: [222, 180, 138],
    b: [222, 180, 138],
  },
};
/** Lines need the full hue where surfaces only need a hint of it. */
const INK: Record<"light" | "dark", Record<Region, Rgb>> = {
  light: {
    a: [37, 99, 190],
    aWithoutB: [37, 99, 190],
    intersection: [150, 66, 158],
    bWithoutA: [196, 98, 16],
    b: [196, 98, 16],
  },
  dark: {
    a: [122, 170, 255],
    aWithoutB: [122, 170, 255],
    intersection: [226, 150, 232],
    bWithoutA: [255, 176, 96],
    b: [255, 176, 96],
  },
};

/** Points that are painted: strong, since it stands for what is compared. */
const MARK: Record<"light" | "dark", Rgb> = { light: [178, 84, 188], dark: [226, 130, 236] };

const fades = new WeakMap<Uint32Array, Float32Array | null>();

export function contentsOf(scene: Scene, regions: readonly Region[]): PaneContent[] {
  return regions.flatMap((region) => contentOf(scene, region) ?? []);
}

export function contentOf(scene: Scene, region: Region): PaneContent | null {
  const found = scene.shapes[region];
  const own = ownGeometry(scene, region);
  const current = found && geometryFor(scene, region, found.mean.length);
  // A model that was just opened is shown before anything was compared.
  const alone = region === "a" || region === "b";
  const geometry = current ?? (alone ? own : null);
  // One canvas shows the plane or space, not both: of two models that do not match, A.
  if (!geometry || geometry.dimension !== dimensionOf(scene)) return null;
  const shown = current && found ? found : { mean: geometry.mean, vertexSd: geometry.vertexSd };
  const many = scene.mode === "samples" && current && found;
  const surface = geometry.triangles !== null;
  const cloud = isCloud(geometry);
  const shapes = many || (cloud && found && current) ? samplesOf(found) : [shown.mean];
  const shade = scene.dark ? "dark" : "light";
  return {
    region,
    shapes,
    overlaid: cloud || geometry.segments !== null,
    triangles: geometry.triangles,
    segments: geometry.segments,
    // The rim of a region is no cut at the neck.
    fade:
      scene.fadeRim && geometry.triangles && !isCompared(scene, geometry) ? fadeOf(geometry) : null,
    values: scene.mode === "sd" ? valuesOf(scene, region, shown.vertexSd) : null,
    palette: scene.map?.palette ?? "viridis",
    ellipsoid: current ? drawnEllipsoid(scene, region) : null,
    marks: null,
    tint: (surface ? CLAY : INK)[shade][region],
  };
}

/** What a shape of so many numbers is drawn with in the pane of a region; null where no model has as many. */
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

/** The colour of a region: as clay, or as lines of its full hue. */
export function tintOf(scene: Scene, region: Region, lines: boolean): Rgb {
  return (lines ? INK : CLAY)[scene.dark ? "dark" : "light"][region];
}

/** Of other points than are drawn, a map says nothing. */
function valuesOf(scene: Scene, region: Region, vertexSd: Float32Array): Float32Array | null {
  if (!scene.map) return vertexSd;
  const found = scene.map.values[region];
  return found?.length === vertexSd.length ? found : null;
}

/** Over light and dark colours of a map: neither is any of its own. */
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

/** Models of a few loose points: their samples mean something only all at once. */
export function isCloud(geometry: Geometry): boolean {
  const points = geometry.mean.length / geometry.dimension;
  return geometry.triangles === null && geometry.segments === null && points <= 8;
}

/** One card's picture: the model's own mean. */
export function cardContent(geometry: Geometry, side: Region, scene: Scene): PaneContent | null {
  const alone = { ...scene, compared: null, shapes: {}, mode: "mean" as const };
  return contentOf({ ...alone, geometry: { a: geometry, b: geometry } }, side);
}

/** One frame for all panes, whatever they show just now. */
export function sceneFrame(scene: Scene): Frame {
  const dimension = dimensionOf(scene) ?? 3;
  const means = contentsOf({ ...scene, mode: "mean" }, ["a", "b"]);
  const many = scene.mode === "samples" || means.some((content) => content.overlaid);
  const shown = many ? contentsOf({ ...scene, mode: "samples" }, REGIONS) : means;
  const fade = means[0]?.fade ?? null;
  return frameOf(
    [...means, ...shown].flatMap((content) => content.shapes),
    dimension,
    fade,
  );
}

export function dimensionOf({ geometry }: Scene): 2 | 3 | null {
  return (geometry.a ?? geometry.b)?.dimension ?? null;
}

const split = new WeakMap<RegionShapes, Float32Array[]>();

/** Always the same arrays for the same shapes, so that a viewer can keep what it made of them. */
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

function ownGeometry(scene: Scene, region: Region): Geometry | null {
  return scene.geometry[sideOf(region)];
}

function sideOf(region: Region): "a" | "b" {
  return region === "b" || region === "bWithoutA" ? "b" : "a";
}

/** What shapes of so many numbers are drawn with: surfaces if there are any, its own side's first. */
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

/** Model A alone, with the points that are marked in the colour of what both share. */
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
