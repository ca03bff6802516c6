/** The share of shapes that count as outside the other model, by σ: interpolates the curve of a report. Pure. */
import type { ReachCurve, Report, Side } from "../../worker/protocol";
import { DIFFERENCE_OF, letters } from "../state/regions";
import { length, percent } from "../text/format";
import { type Phrase, reported } from "../text/phrase";

const SIDES: Side[] = ["a", "b"];

/** The distance d of which 1 − exp(−½(d/σ)²) is this share. */
function equivalentDistance(share: number, sigma: number): number {
  return sigma * Math.sqrt(-2 * Math.log1p(-share));
}

/**
 * The share at a σ, between the points of the curve and beyond them. What is interpolated, linearly in log σ, is the
 * equivalent distance: it hardly varies where the share falls from all to none, and is that of every shape where all
 * are at one distance.
 */
export function shareAt(curve: ReachCurve, side: Side, sigma: number): number {
  const shares = curve[DIFFERENCE_OF[side]];
  const points = curve.sigma
    .map((at, i) => ({ at, distance: equivalentDistance(shares[i] ?? 1, at) }))
    // A share that is rounded to 1 says nothing of the distance.
    .filter(({ distance }) => Number.isFinite(distance));
  const after = points.findIndex(({ at }) => at >= sigma);
  const next = points[after] ?? points.at(-1);
  if (!next) return 1;
  const former = points[after - 1] ?? next;
  const between = former === next ? 0 : Math.log(sigma / former.at) / Math.log(next.at / former.at);
  const distance = former.distance + between * (next.distance - former.distance);
  return -Math.expm1(-0.5 * (distance / sigma) ** 2);
}

/** Points to draw the curve of a model by. */
const POINTS = 120;

/** The curve of a model over a range of σ, its ends included. */
export function curveOver(
  curve: ReachCurve,
  side: Side,
  [low, high]: readonly [number, number],
): [sigma: number, share: number][] {
  return Array.from({ length: POINTS + 1 }, (_, i) => {
    const sigma = low * (high / low) ** (i / POINTS);
    return [sigma, shareAt(curve, side, sigma)];
  });
}

export type MarkKind = "left-out" | "meeting" | "recommended";

/** A σ to compare with that in use. */
export interface SigmaMark {
  kind: MarkKind;
  /** Whose it is, of a left-out error. */
  side: Side | null;
  sigma: number;
}

/** Left-out errors below this share of the size of A are rounding, as in the choice of σ. */
const ROUNDING = 1e-6;
/** Distances to the other model below this share of those from the own mean are rounding, as in the answer. */
const NO_DISTANCE = 1e-5;

/** What the model of the others misses of the shapes of a model; null where that is not known. */
function leftOut({ evidence, models }: Report, side: Side) {
  const found = evidence?.leftOut[side];
  return found && found.mean > ROUNDING * models.a.size ? found : null;
}

export function sigmaMarks(report: Report, recommended: number | null): SigmaMark[] {
  const meeting = report.reach?.meeting ?? 0;
  return [
    ...SIDES.flatMap((side): SigmaMark[] => {
      const found = leftOut(report, side);
      return found ? [{ kind: "left-out", side, sigma: found.mean }] : [];
    }),
    ...(meeting > 0 ? [{ kind: "meeting" as const, side: null, sigma: meeting }] : []),
    ...(recommended === null
      ? []
      : [{ kind: "recommended" as const, side: null, sigma: recommended }]),
  ];
}

/** What the marks are, with their values. */
export function marksText(marks: readonly SigmaMark[], unit: string): string {
  const names: Record<MarkKind, (side: Side | null) => string> = {
    "left-out": (side) => `left-out shapes of ${side?.toUpperCase()} from their own model`,
    meeting: () => "least distance of plausible shapes",
    recommended: () => "recommended σ",
  };
  const each = marks.map(({ kind, side, sigma }) => `${names[kind](side)} ${length(sigma, unit)}`);
  return each.length === 0 ? "" : `Marks: ${each.join(", ")}.`;
}

/** Whether the other model makes all shapes of this one. */
export function isContained({ reach }: Report, side: Side): boolean {
  const found = side === "a" ? reach?.aToB : reach?.bToA;
  return found !== undefined && found.relative <= NO_DISTANCE;
}

/** Whether two σ are the same but for rounding. */
const same = (one: number, other: number | null) =>
  other !== null && Math.abs(one / other - 1) < 1e-9;

/** How much of each model counts as outside the other at a σ, and of its own left-out shapes where that is known. */
export function outsideSentence(report: Report, sigma: number): Phrase {
  const curve = report.reach?.curve;
  if (!curve || curve.sigma.length === 0) return [];
  const used = same(sigma, report.settings.sigma);
  const { unit } = report.models.a;
  const text = length(sigma, unit);
  return [
    "At σ ",
    used ? reported("settings.sigma", sigma, text) : text,
    ", ",
    ...outside(report, curve, "a", sigma, used),
    " of the shapes of A count as outside B, ",
    ...outside(report, curve, "b", sigma, used),
    " of those of B as outside A.",
    ...(used ? reference(report) : []),
  ];
}

/** The share of a model: that of the draws at the σ of the report, else about that of the curve. */
function outside(
  report: Report,
  curve: ReachCurve,
  side: Side,
  sigma: number,
  used: boolean,
): Phrase {
  const key = DIFFERENCE_OF[side];
  if (isContained(report, side)) return ["none"];
  const { probability, diagnostics } = report.differences[key];
  const soft = (report.settings.difference ?? "soft") === "soft";
  // A run that was ended early may have drawn no difference.
  if (used && soft && diagnostics.evaluations > 0) {
    return [reported(`differences.${key}.probability`, probability, written(probability))];
  }
  const text = written(shareAt(curve, side, sigma));
  return [/\d/.test(text) ? `about ${text}` : text];
}

/** A share that draws or a curve give; never “100 %” nor “0 %”, for some shape is always farther or nearer. */
function written(share: number): string {
  if (share > 0.9999) return "nearly all";
  return share < 0.0001 ? "hardly any" : percent(share);
}

/** The same share of shapes of the own population, which the other is to be compared with. */
function reference(report: Report): Phrase {
  const found = SIDES.flatMap((side) => {
    const beyond = leftOut(report, side)?.beyondSigma;
    return beyond == null ? [] : [{ side, beyond }];
  });
  return found.flatMap(({ side, beyond }, i): Phrase => {
    const [own] = letters(side);
    const share = reported(`evidence.leftOut.${side}.beyondSigma`, beyond, percent(beyond));
    const whose = i === 0 ? ` Of ${own}’s own shapes, each left out of it, ` : `, of ${own}’s `;
    const verb = i === 0 ? " would count" : "";
    return [whose, share, `${verb} as outside ${own}${i === found.length - 1 ? "." : ""}`];
  });
}
