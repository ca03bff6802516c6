/** Computes the contents of the three panes of the explorer: shapes, colours and residuals. Pure. */
import type { Explored, Nearest, Space } from "../../../worker/protocol";
import type { ExplorerState } from "../../state/explorer";
import { contentOf, drawnWith, isCloud, type Scene, tintOf } from "../../viewer/contents";
import { blended, magnified } from "../../viewer/morph";
import { drawsAlike, type Moved, type PaneContent } from "../../viewer/viewer";
import { otherOf } from "./words";

/** The panes: A, both overlaid, and B. */
export const EXPLORE_PANES = ["a", "intersection", "b"] as const;
export type ExplorePane = (typeof EXPLORE_PANES)[number];

export interface ExploreScene {
  scene: Scene;
  state: ExplorerState;
  /** The directions of the answer. */
  space: Space;
  angles: boolean;
  explored: Explored;
  partner: Explored | null;
  /** The shape from which deviations are magnified. */
  mean: Float32Array;
}

/** Which panes are shown. */
export function panesOf({ layout }: ExplorerState): readonly ExplorePane[] {
  if (layout === "side") return EXPLORE_PANES;
  return [layout === "overlaid" ? "intersection" : layout];
}

export function exploreContents(explore: ExploreScene): PaneContent[] {
  const shown = panesOf(explore.state);
  const { space, angles } = explore;
  const layers =
    space === "intersection" ? ofBoth(explore) : angles ? ofAngle(explore) : ofOne(explore, space);
  const drawn = layers.flatMap((layer) =>
    shown.includes(layer.pane) ? (contentOfLayer(explore, layer) ?? []) : [],
  );
  return [...drawn, ...shown.flatMap((pane) => backdrop(explore.scene, pane) ?? [])];
}

interface Layer {
  pane: ExplorePane;
  /** The model whose colour it has. */
  of: Space;
  shape: Float32Array;
  values: Float32Array | null;
  outline: boolean;
}

/** A shape of A or of B, and the nearest shape of the other model. */
function ofOne({ state, explored }: ExploreScene, space: "a" | "b"): Layer[] {
  const other = otherOf(space);
  const nearest = explored.nearest?.[other];
  const missed = heat(state, nearest?.residuals);
  const { shape } = explored;
  const x = { of: space, shape, outline: false };
  const layers: Layer[] = [
    { ...x, pane: space, values: missed },
    // If the pane of the shape is hidden, its residual is coloured here.
    { ...x, pane: "intersection", values: state.layout === "overlaid" ? missed : null },
  ];
  if (!nearest) return layers;
  const found = { of: other, shape: nearest.shape, values: null };
  return [
    ...layers,
    { ...found, pane: "intersection", outline: true },
    { ...found, pane: other, outline: false },
  ];
}

/** A shape of A∩B and the nearest shapes of A and of B. */
function ofBoth({ state, explored }: ExploreScene): Layer[] {
  const { shape, nearest } = explored;
  const overlaid = state.layout === "overlaid";
  const larger =
    nearest && overlaid ? largest(nearest.a.residuals, nearest.b.residuals) : undefined;
  const x: Layer = {
    pane: "intersection",
    of: "intersection",
    shape,
    values: heat(state, larger),
    outline: false,
  };
  if (!nearest) return [x];
  return [
    x,
    ...(["a", "b"] as const).flatMap((side) => {
      const { shape, residuals } = nearest[side];
      const found = { of: side, shape };
      return [
        { ...found, pane: side, values: heat(state, residuals), outline: false },
        { ...found, pane: "intersection" as const, values: null, outline: true },
      ];
    }),
  ];
}

/** The two shapes of a principal angle, and the interpolation between them. */
function ofAngle({ state, space, explored, partner }: ExploreScene): Layer[] {
  const other = otherOf(space);
  const missed = heat(state, explored.nearest?.[other].residuals);
  const driven: Layer = {
    pane: space as "a" | "b",
    of: space,
    shape: explored.shape,
    values: missed,
    outline: false,
  };
  if (!partner) return [driven];
  const [a, b] = space === "a" ? [explored, partner] : [partner, explored];
  return [
    driven,
    {
      pane: "intersection",
      of: "intersection",
      shape: blended(a.shape, b.shape, state.morph),
      values: null,
      outline: false,
    },
    { pane: other, of: other, shape: partner.shape, values: null, outline: false },
  ];
}

function heat({ heat }: ExplorerState, residuals: Float32Array | undefined): Float32Array | null {
  return heat ? (residuals ?? null) : null;
}

function largest(one: Float32Array, other: Float32Array): Float32Array {
  return one.map((value, i) => Math.max(value, other[i] ?? 0));
}

function contentOfLayer(explore: ExploreScene, layer: Layer): PaneContent | null {
  const { scene, state, mean } = explore;
  const drawn = drawnWith(scene, layer.pane, layer.shape.length);
  if (!drawn || mean.length !== layer.shape.length) return null;
  const { style } = state;
  const lines = drawn.triangles === null || style === "wireframe" || layer.outline;
  return {
    ...drawn,
    shapes: [magnified(layer.shape, mean, state.magnify)],
    values: layer.values,
    marks: null,
    tint: tintOf(scene, layer.of, lines),
    style,
    outline: layer.outline,
    moves: true,
  };
}

/** Random shapes of a model of few points, which are drawn around the single shape. */
function backdrop(scene: Scene, pane: ExplorePane): PaneContent | null {
  const { a, b } = scene.geometry;
  if (!a || !b || !isCloud(a) || !isCloud(b)) return null;
  return contentOf({ ...scene, mode: "mean" }, pane);
}

/** Quantile of the residuals at which the colours end: outliers at a rim would leave all others dark. */
const WITHIN = 0.99;
const MOST_ORDERED = 4000;

/** Upper end of the colour bar: a round number, so that colours do not flicker. */
export function heatEnd(maps: readonly Float32Array[]): number {
  const ends = maps.map((map) => {
    // A sample of the vertices gives the quantile well enough, in time for the next frame.
    const step = Math.ceil(map.length / MOST_ORDERED);
    const ordered = map.filter((_, vertex) => vertex % step === 0).sort();
    return ordered[Math.ceil(WITHIN * (ordered.length - 1))] ?? 0;
  });
  return roundUp(Math.max(0, ...ends));
}

/** Rounds up to the next of …, 0.1, 0.2, 0.5, 1, 2, 5, … */
export function roundUp(value: number): number {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  const step = [1, 2, 5, 10].find((part) => part * power >= value * (1 - 1e-9)) ?? 10;
  return Number((step * power).toPrecision(1));
}

/** The residuals of the answer that may be coloured. */
export function missedBy(space: Space, nearest: Record<"a" | "b", Nearest>): Float32Array[] {
  const { a, b } = nearest;
  return space === "intersection"
    ? [a.residuals, b.residuals]
    : [nearest[otherOf(space)].residuals];
}

/** The moves that turn one content into the next, if only points and colours changed; else null. */
export function movedFrom(
  former: readonly PaneContent[],
  next: readonly PaneContent[],
): (Moved | null)[] | null {
  if (former.length !== next.length) return null;
  const same = next.every((content, i) => {
    const before = former[i];
    return before !== undefined && looksLike(before, content);
  });
  if (!same) return null;
  return next.map(({ moves, shapes: [shape], values }) =>
    moves && shape ? { shape, values } : null,
  );
}

function looksLike(one: PaneContent, other: PaneContent): boolean {
  return (
    drawsAlike(one, other) &&
    one.tint.every((channel, i) => channel === other.tint[i]) &&
    (one.values === null) === (other.values === null) &&
    one.shapes[0]?.length === other.shapes[0]?.length &&
    (one.moves === true || one.shapes === other.shapes)
  );
}
