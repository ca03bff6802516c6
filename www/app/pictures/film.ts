/** Computes what an animation shows at each moment: keyframes, interpolation, label. Pure. */
import type { Report } from "../../worker/protocol";
import { number } from "../text/format";

/** What is animated: a mode of a model, or the change from A’s mean through that of A∩B to B’s. */
export type Subject = "a" | "b" | "intersection" | "morph";
export type Format = "gif" | "webm";

export interface FilmOptions {
  subject: Subject;
  /** From 0. */
  mode: number;
  format: Format;
  /** Width in pixels. */
  size: number;
  seconds: number;
  /** Whether it ends where it began, and a GIF repeats. */
  loops: boolean;
  label: boolean;
  background: "white" | "dark";
}

export const FIRST_FILM: FilmOptions = {
  subject: "intersection",
  mode: 0,
  format: "gif",
  size: 480,
  seconds: 4,
  loops: true,
  label: true,
  background: "white",
};

export const SIZES = { least: 120, most: 1920 } as const;
export const SECONDS = { least: 1, most: 30 } as const;
/** Frames per second; GIFs count hundredths of a second, so a frame is four of them. */
export const FRAMES_PER_SECOND = 25;
/** Largest coefficient of a mode, in standard deviations. */
export const REACH_SD = 3;

export function frameCount({ seconds }: FilmOptions): number {
  return Math.round(seconds * FRAMES_PER_SECOND);
}

/** Time of a frame as a share of the duration; the last frame of a loop is just before the first. */
export function momentOf(options: FilmOptions, frame: number): number {
  const frames = frameCount(options);
  return frame / (options.loops ? frames : Math.max(1, frames - 1));
}

/**
 * Position of the animation after a share of its time, 0 … 1: standard deviations of a mode, −3 … 3; or of a morph
 * 0 at A, 1 at A∩B, 2 at B. It slows down where it turns.
 */
export function positionAt({ subject, loops }: FilmOptions, moment: number): number {
  const swing = -Math.cos((loops ? 2 : 1) * Math.PI * moment);
  return subject === "morph" ? 1 + swing : REACH_SD * swing;
}

type Rgb = readonly [number, number, number];

export interface Keyframe {
  at: number;
  shape: Float32Array;
  tint: Rgb;
}

/** Shape between two keyframes by linear interpolation, which is exact since models are linear. */
export function blend(keys: readonly Keyframe[], position: number): Omit<Keyframe, "at"> | null {
  const beyond = keys.findIndex(({ at }) => at >= position);
  const next = beyond === -1 ? keys.length - 1 : Math.max(1, beyond);
  const [from, to] = [keys[next - 1], keys[next]];
  if (!from || !to) return keys[0] ?? null;
  const share = Math.min(1, Math.max(0, (position - from.at) / (to.at - from.at)));
  const mix = (one: number, other: number) => one + share * (other - one);
  const [r, g, b] = from.tint;
  return {
    shape: from.shape.map((value, i) => mix(value, to.shape[i] ?? value)),
    tint: [mix(r, to.tint[0]), mix(g, to.tint[1]), mix(b, to.tint[2])],
  };
}

const SIGNS = { a: "A", b: "B", intersection: "A∩B" } as const;

/** Label above the shape at a moment. */
export function labelAt(options: FilmOptions, position: number): string {
  const { subject, mode } = options;
  if (subject === "morph") {
    const share = (of: number) => `${Math.round(100 * of)}\u202f%`;
    if (position <= 1) return position < 0.005 ? "A" : `A → A∩B, ${share(position)}`;
    return position > 1.995 ? "B" : `A∩B → B, ${share(position - 1)}`;
  }
  const deviations = `${position > 0 ? "+" : ""}${number(Math.round(10 * position) / 10, 2)}`;
  return `${SIGNS[subject]}, mode ${mode + 1}: ${deviations} SD`;
}

/** Describes the animation in one sentence. */
export function filmSentence(options: FilmOptions, report: Report): string {
  const { subject, mode, loops } = options;
  const { a, b } = report.models;
  if (subject === "morph") {
    const way = loops ? "and back" : "once";
    return `From the mean of A (${a.name}) through that of A∩B to that of B (${b.name}), ${way}.`;
  }
  const name = { a: ` (${a.name})`, b: ` (${b.name})`, intersection: "" }[subject];
  const way = loops
    ? `−${REACH_SD} to +${REACH_SD} SD and back`
    : `−${REACH_SD} to +${REACH_SD} SD`;
  return `Mode ${mode + 1} of ${SIGNS[subject]}${name}, ${way}.`;
}

export function filmName({ subject, mode, format }: FilmOptions): string {
  const what =
    subject === "morph"
      ? "a-to-b"
      : `${subject === "intersection" ? "ab" : subject}-mode-${mode + 1}`;
  return `shapevenn-${what}.${format}`;
}
