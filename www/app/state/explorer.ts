/**
 * State of the explorer and its part of the link: in `explore=a,modes,1:2.5,4:-1` the fourth axis has −1 standard
 * deviation. A value without a number belongs to the next axis. Pure.
 */
import type { AxesKind, Space } from "../../worker/protocol";
import { parseSeed } from "./settings";

export type SurfaceStyle = "smooth" | "flat" | "wireframe";
/** Layout of the panes: all three, the middle one with both models overlaid, or A or B alone. */
export type ExploreLayout = "side" | "overlaid" | "a" | "b";

export interface ExplorerState {
  /** The model whose shape is set, and the directions of the sliders. */
  space: Space;
  kind: AxesKind;
  /** The random shape to which `own` is added; null for the mean. */
  seed: string | null;
  /** Coefficients of single axes, from 0, in standard deviations. */
  own: Readonly<Record<number, number>>;
  /** Factor by which deviations from the mean are magnified. */
  magnify: number;
  style: SurfaceStyle;
  layout: ExploreLayout;
  /** Whether the residual in the other model is coloured. */
  heat: boolean;
  /** Interpolation between the shapes of a principal angle, 0 for A's and 1 for B's. */
  morph: number;
}

export const SPACES: Space[] = ["a", "intersection", "b"];
export const KINDS: AxesKind[] = ["modes", "exclusive", "relative", "angles"];
export const STYLES: SurfaceStyle[] = ["smooth", "flat", "wireframe"];
export const LAYOUTS: ExploreLayout[] = ["side", "overlaid", "a", "b"];

/** Largest coefficient of the sliders, in standard deviations. */
export const REACH_SD = 3;
/** Largest coefficient that can be typed or dragged. */
export const MOST_SD = 20;
export const MOST_MAGNIFY = 10;
const MOST_AXES = 10_000;
const DIGITS = 3;

export function defaultExplorer(): ExplorerState {
  return {
    space: "a",
    kind: "modes",
    seed: null,
    own: {},
    magnify: 1,
    style: "smooth",
    layout: "side",
    heat: true,
    morph: 0.5,
  };
}

/** Rounds a coefficient as links do, so that an opened link has the same shape. */
export function rounded(coefficient: number): number {
  const bounded = Math.min(MOST_SD, Math.max(-MOST_SD, coefficient));
  return Number(bounded.toFixed(DIGITS)) + 0;
}

/**
 * Standard normal coefficients for the axes, clamped to the range of the sliders. They are sums of twelve uniform
 * numbers, which have the same bits in every browser, unlike logarithms and cosines.
 */
export function randomCoefficients(seed: string, count: number): number[] {
  let state = 2_166_136_261;
  for (const letter of seed) state = Math.imul(state ^ letter.charCodeAt(0), 16_777_619);
  // Mulberry32.
  const uniform = () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return (mixed ^ (mixed >>> 14)) >>> 0;
  };
  return Array.from({ length: count }, () => {
    let sum = 0;
    for (let i = 0; i < 12; i += 1) sum += uniform();
    const normal = sum / 2 ** 32 - 6;
    return rounded(Math.min(REACH_SD, Math.max(-REACH_SD, normal)));
  });
}

/** A coefficient for each of `count` axes; values of a link for further axes are ignored. */
export function coefficientsOf({ seed, own }: ExplorerState, count: number): number[] {
  const base = seed === null ? [] : randomCoefficients(seed, count);
  return Array.from({ length: count }, (_, i) => own[i] ?? base[i] ?? 0);
}

export function writeExplorer(state: ExplorerState): [string, string | number][] {
  const standard = defaultExplorer();
  const pairs: [string, string | number][] = [];
  const drive = [state.space, state.kind, ...writeOwn(state)].join(",");
  if (drive !== `${standard.space},${standard.kind}`) pairs.push(["explore", drive]);
  if (state.seed !== null) pairs.push(["random", state.seed]);
  for (const key of ["magnify", "style", "layout", "morph"] as const) {
    if (state[key] !== standard[key]) pairs.push([key, state[key]]);
  }
  if (!state.heat) pairs.push(["heat", "off"]);
  return pairs;
}

function writeOwn({ own, seed }: ExplorerState): string[] {
  let last = Number.NaN;
  return Object.entries(own)
    .map(([axis, value]) => [Number(axis), rounded(value)] as const)
    .filter(([, value]) => value !== 0 || seed !== null)
    .sort(([one], [other]) => one - other)
    .map(([axis, value]) => {
      const next = axis === last + 1;
      last = axis;
      return next ? String(value) : `${axis + 1}:${value}`;
    });
}

export function readExplorer(given: URLSearchParams): ExplorerState {
  const standard = defaultExplorer();
  const [first, second, ...rest] = (given.get("explore") ?? "").split(",");
  const space = SPACES.find((name) => name === first) ?? standard.space;
  const kind = KINDS.find((name) => name === second) ?? standard.kind;
  const seed = parseSeed(given.get("random") ?? "");
  return {
    space,
    // Directions that compare two models belong to A or B, not to A∩B.
    kind: space === "intersection" ? "modes" : kind,
    seed: seed === "invalid" ? null : seed,
    own: readOwn(rest),
    magnify: within(given.get("magnify"), 1, MOST_MAGNIFY) ?? standard.magnify,
    style: STYLES.find((name) => name === given.get("style")) ?? standard.style,
    layout: LAYOUTS.find((name) => name === given.get("layout")) ?? standard.layout,
    heat: given.get("heat") !== "off",
    morph: within(given.get("morph"), 0, 1) ?? standard.morph,
  };
}

function readOwn(items: string[]): Record<number, number> {
  const own: Record<number, number> = {};
  let axis = -1;
  for (const item of items) {
    const [, place, text = ""] = /^(?:(\d{1,5}):)?(-?[\d.]+)$/.exec(item) ?? [];
    axis = place === undefined ? axis + 1 : Number(place) - 1;
    const value = Number(text);
    if (text === "" || !Number.isFinite(value) || axis < 0 || axis >= MOST_AXES) continue;
    own[axis] = rounded(value);
  }
  return own;
}

function within(text: string | null, least: number, most: number): number | null {
  const value = Number(text ?? Number.NaN);
  return value >= least && value <= most ? value : null;
}
