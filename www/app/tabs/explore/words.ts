/** Sentences of the explorer: names of directions, how plausible a shape is, which model can make it. Pure. */
import type { Axes, AxesKind, Space } from "../../../worker/protocol";
import { degrees, length, number } from "../../text/format";

export const SIGNS: Record<Space, string> = { a: "A", b: "B", intersection: "A∩B" };

export function otherOf(space: Space): "a" | "b" {
  return space === "a" ? "b" : "a";
}

/** The models whose nearest shape to a shape of this one is computed. */
export function followers(space: Space): ("a" | "b")[] {
  return space === "intersection" ? ["a", "b"] : [otherOf(space)];
}

export function followQuestion(space: Space): string {
  if (space === "intersection") return "Can A and B make this shape of A∩B?";
  return `Can ${SIGNS[otherOf(space)]} make this shape of ${SIGNS[space]}?`;
}

/** Name of a kind of directions of one model. */
export function kindLabel(kind: AxesKind, space: Space): string {
  const [own, other] = [SIGNS[space], SIGNS[otherOf(space)]];
  switch (kind) {
    case "modes":
      return `Modes of ${own}`;
    case "exclusive":
      return `Exclusive modes of ${own}`;
    case "relative":
      return `Relative modes of ${own} to ${other}`;
    case "angles":
      return "Principal angles";
  }
}

/** Explains in one sentence by what the directions are ordered. */
export function orderSentence({ kind, space, noise }: Axes, unit: string): string {
  const [own, other] = [SIGNS[space], SIGNS[otherOf(space)]];
  switch (kind) {
    case "modes":
      return `Ordered by how far one standard deviation (SD) moves the points of ${own}, root mean square (RMS) over all points.`;
    case "exclusive":
      return `Directions of ${own} ordered by the part of one SD that ${other} cannot make, RMS over all points.`;
    case "relative": {
      const with_ = noise === null ? "" : `, both with noise of ${length(noise, unit)} added`;
      return `Ordered by the variance of ${own} along the direction over that of ${other}${with_}.`;
    }
    case "angles":
      return `Ordered by the angle between a direction of ${own} and its partner in ${other}: at 0° both models have the direction, at 90° ${other} has nothing of it.`;
  }
}

/** The value by which a direction is ordered, with its unit. */
export function valueText(kind: AxesKind, value: number, unit: string): string {
  if (kind === "angles") return degrees(value);
  if (kind === "relative") return `${number(value)}\u202f×`;
  return length(value, unit);
}

/** The same value in words, for the label of a slider. */
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

/** The part of one SD along a direction that the other model cannot make, unless that is the value already shown. */
export function missedText(
  { kind, space, residual, reach }: Axes,
  axis: number,
  unit: string,
): string | null {
  const missed = residual[axis];
  if (kind === "exclusive" || space === "intersection" || missed === undefined) return null;
  // Rounding error is shown as nothing.
  const text = missed < 1e-9 * (reach[axis] ?? 0) ? "nothing" : `${number(missed, 2)}\u202f${unit}`;
  return `${SIGNS[otherOf(space)]} misses ${text}`;
}

/** How plausible a shape is among the shapes of its model, of which the share `share` is less plausible. */
export function unusual(share: number, model: string): string {
  return Number.isFinite(share) ? `${rarity(share)} of ${model}’s own shapes` : "–";
}

export function rarity(share: number): string {
  if (share > 0.99) return "more plausible than nearly all";
  if (share >= 0.5) return `more plausible than ${Math.floor(10 * share)} in 10`;
  if (share < 1e-6) return "rarer than 1 in a million";
  const odds = Number((1 / share).toPrecision(2));
  const digits = odds < 10 ? 1 : 2;
  return `among the rarest 1 in ${number(odds, digits)}`;
}

/** Likelihood L_D at a distance of σ, and at 2 σ. */
const WITHIN = Math.exp(-0.5);
const NEAR = Math.exp(-2);

export type Maker = "a" | "nearlyBoth" | "both" | "b" | "neither";

/** Which of the two models can make a shape, from the likelihoods L_D of both. */
export function whoCanMake(ofA: number, ofB: number): Maker {
  const [least, most] = [Math.min(ofA, ofB), Math.max(ofA, ofB)];
  if (most < NEAR) return "neither";
  if (least >= WITHIN) return "both";
  if (least >= NEAR) return "nearlyBoth";
  return ofA > ofB ? "a" : "b";
}

/** Value of the meter, from −1 (A only) through 0 to 1 (B only). */
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

/** Share of less plausible shapes below which a shape is called implausible in its model. */
const RARE = 1e-3;

/** Whether a model can make a shape: from the distance of its nearest shape in σ and the plausibility of that. */
export function followWords(
  model: string,
  { distance, plausibility }: { distance: number; plausibility: number },
  sigma: number | null,
): string {
  if (sigma === null) return `The nearest shape of ${model} is shown.`;
  const times = distance / sigma;
  if (times > 2) return `No: the nearest shape of ${model} is ${number(times, 2)} σ away.`;
  if (times > 1) return `Nearly: the nearest shape of ${model} is ${number(times, 2)} σ away.`;
  const rare = plausibility < RARE ? `, but implausible in ${model}` : "";
  return `Yes: the nearest shape of ${model} is within σ${rare}.`;
}
