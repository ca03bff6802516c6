/** What the explorer says of shapes and directions. Pure. */
import type { Axes, AxesKind, Space } from "../../../worker/protocol";
import { degrees, length, number } from "../../text/format";

export const SIGNS: Record<Space, string> = { a: "A", b: "B", intersection: "A∩B" };

export function otherOf(space: Space): "a" | "b" {
  return space === "a" ? "b" : "a";
}

/** Who is asked whether it can make a shape of this model too. */
export function followers(space: Space): ("a" | "b")[] {
  return space === "intersection" ? ["a", "b"] : [otherOf(space)];
}

export function followQuestion(space: Space): string {
  if (space === "intersection") return "Can A and B follow A∩B?";
  return `Can ${SIGNS[otherOf(space)]} follow ${SIGNS[space]}?`;
}

/** What directions are called, of one side. */
export function kindLabel(kind: AxesKind, space: Space): string {
  const [own, other] = [SIGNS[space], SIGNS[otherOf(space)]];
  switch (kind) {
    case "modes":
      return `Modes of ${own}`;
    case "exclusive":
      return `What ${other} cannot follow`;
    case "relative":
      return `Where ${own} varies most beside ${other}`;
    case "angles":
      return "Principal angles";
  }
}

/** What the order of the directions means, in one sentence. */
export function orderSentence({ kind, space, noise }: Axes, unit: string): string {
  const [own, other] = [SIGNS[space], SIGNS[otherOf(space)]];
  switch (kind) {
    case "modes":
      return `In order of how far one standard deviation (SD) moves the points of ${own}, as root mean square (RMS) over all of them.`;
    case "exclusive":
      return `In order of what ${other} misses of one SD: how far the points stay away, as RMS, once ${other} has followed as well as it can.`;
    case "relative": {
      const with_ = noise === null ? "" : `, both with noise of ${length(noise, unit)} added`;
      return `In order of how many times as much ${own} varies along the direction as ${other} does${with_}.`;
    }
    case "angles":
      return `In order of the angle between a direction of ${own} and its partner in ${other}: at 0° both vary in the same way, at 90° ${other} cannot follow at all.`;
  }
}

/** What orders one direction, with its unit. */
export function valueText(kind: AxesKind, value: number, unit: string): string {
  if (kind === "angles") return degrees(value);
  if (kind === "relative") return `${number(value)}\u202f×`;
  return length(value, unit);
}

/** The same as words for one slider. */
export function valueWords({ kind, space }: Axes, value: number, unit: string): string {
  const text = valueText(kind, value, unit);
  const other = SIGNS[otherOf(space)];
  switch (kind) {
    case "modes":
      return `${text} per SD`;
    case "exclusive":
      return `${other} misses ${text} per SD`;
    case "relative":
      return `${text} the variance of ${other}`;
    case "angles":
      return `${text} to its partner`;
  }
}

/** Beside what orders the directions: what the other model cannot make of one SD along this one. */
export function missedText(
  { kind, space, residual, reach }: Axes,
  axis: number,
  unit: string,
): string | null {
  const missed = residual[axis];
  if (kind === "exclusive" || space === "intersection" || missed === undefined) return null;
  // What is only rounding error is none.
  const text = missed < 1e-9 * (reach[axis] ?? 0) ? "nothing" : `${number(missed, 2)}\u202f${unit}`;
  return `${SIGNS[otherOf(space)]} misses ${text}`;
}

/** How unusual a shape is among those of its model, of which `share` are less plausible. */
export function unusual(share: number, model: string): string {
  return Number.isFinite(share) ? `${rarity(share)} of ${model}’s own shapes` : "–";
}

export function rarity(share: number): string {
  if (share > 0.99) return "more ordinary than nearly all";
  if (share >= 0.5) return `more ordinary than ${Math.floor(10 * share)} in 10`;
  if (share < 1e-6) return "rarer than 1 in a million";
  const odds = Number((1 / share).toPrecision(2));
  const digits = odds < 10 ? 1 : 2;
  return `as unusual as 1 in ${number(odds, digits)}`;
}

/** L_D at a distance of σ, and of twice that. */
const WITHIN = Math.exp(-0.5);
const NEAR = Math.exp(-2);

export type Maker = "a" | "nearlyBoth" | "both" | "b" | "neither";

/** Where a shape lies between two models, from L_D of either. */
export function whoCanMake(ofA: number, ofB: number): Maker {
  const [least, most] = [Math.min(ofA, ofB), Math.max(ofA, ofB)];
  if (most < NEAR) return "neither";
  if (least >= WITHIN) return "both";
  if (least >= NEAR) return "nearlyBoth";
  return ofA > ofB ? "a" : "b";
}

/** From −1, A only, through 0 to 1, B only. */
export function meterValue(ofA: number, ofB: number): number {
  return ofB - ofA;
}

export function meterWords(ofA: number, ofB: number): string {
  switch (whoCanMake(ofA, ofB)) {
    case "both":
      return "Both can make it";
    case "a":
      return "Only A can make it";
    case "b":
      return "Only B can make it";
    case "neither":
      return "Neither can make it";
    case "nearlyBoth":
      return ofA > ofB ? "A can make it, B only nearly" : "B can make it, A only nearly";
  }
}

/** From here on a model can make a shape only in theory. */
const RARE = 1e-3;

/** Whether a model can follow: from how far its nearest shape lies, in σ, and how plausible that is. */
export function followWords(
  model: string,
  { distance, plausibility }: { distance: number; plausibility: number },
  sigma: number | null,
): string {
  if (sigma === null) return `${model} follows as well as it can.`;
  const times = distance / sigma;
  if (times > 2) return `No: ${model} stays ${number(times, 2)} σ away.`;
  if (times > 1) return `Nearly: ${model} stays ${number(times, 2)} σ away.`;
  const rare = plausibility < RARE ? `, though one that is rare in ${model}` : "";
  return `Yes: ${model} makes the same shape within σ${rare}.`;
}
