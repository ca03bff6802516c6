/** Sentences and tables about the measures of a pair: angles, compactness, splitting, generalization. Pure. */
import type { Evaluation, Placement, Report } from "../../worker/protocol";
import type { Nouns } from "../state/demos";
import { count, degrees, length, number, percent } from "../text/format";
import { type Phrase, reported } from "../text/phrase";
import { eachWay, type Group, inUnit } from "./numbers";

/** Numbers from here on are shown as too large; the largest that the engine can have is 1.8 × 10³⁰⁸. */
const BEYOND = 1e300;

export function divergence(value: number): string {
  return value >= BEYOND ? "too large to show" : number(value, 4);
}

/** Why Bhattacharyya distance and Kullback–Leibler divergence need noise to be finite. */
export function noiseSentence(report: Report): Phrase {
  const { bhattacharyyaNoise: noise } = report.overlap;
  return [
    "Each model has directions that the other lacks altogether, so both measures would be infinite: noise of τ = ",
    reported("overlap.bhattacharyyaNoise", noise, length(noise, report.models.a.unit)),
    " is added to every coordinate of both, and as τ → 0 both grow without bound. Compare values at the same τ only.",
  ];
}

/** Directions closer than the first angle count as shared, further apart than the second as not shared. */
const [NEAR, FAR] = [10, 45];

export function angleSentence(angles: readonly number[]): string {
  if (angles.length === 0) return "There are no directions to compare.";
  const near = angles.filter((angle) => angle < NEAR).length;
  const far = angles.filter((angle) => angle > FAR).length;
  return `Of ${count(angles.length)} directions ${near} lie within ${NEAR}° of one another and ${far} more than ${FAR}° apart; at 0° both models have the direction, at 90° it is orthogonal to all directions of the other model.`;
}

export function angleLabel(angles: readonly number[]): string {
  const [first, last] = [angles[0] ?? 0, angles.at(-1) ?? 0];
  return `${angles.length} principal angles, from ${degrees(first)} to ${degrees(last)}.`;
}

const MOST = 0.95;

/** Number of modes that explain a share of the variance. */
export function modesFor(compactness: readonly number[], share: number): number | null {
  const found = compactness.findIndex((value) => value >= share);
  return found < 0 ? null : found + 1;
}

export function compactnessSentence(found: NonNullable<Report["compactness"]>): string {
  const need = (name: string, values: readonly number[]) =>
    `${name} ${modesFor(values, MOST) ?? `more than ${values.length}`}`;
  return `For ${percent(MOST)} of the variance ${need("A needs", found.a)} modes, ${need("B", found.b)}, ${need("A∩B", found.intersection)}.`;
}

export const SPLITTING: Group = {
  title: "The set difference and the linear splitting",
  columns: ["A∖B", "B∖A"],
  rows: [
    eachWay("Weight of A∩B in the model", "linearSplit.weight", percent),
    eachWay("Between the two mean shapes", "linearSplit.meanToMean", inUnit),
    eachWay("Vertex SD of the set difference", "vertexSd.mean", inUnit),
    eachWay("Vertex SD of the splitting", "linearSplit.vertexSd.mean", inUnit),
    eachWay("Variance, splitting over difference", "linearSplit.varianceRatio", (value) =>
      number(value),
    ),
    eachWay("Negative share of its variance", "linearSplit.negativeShare", percent),
  ],
};

export function hasSplitting({ differences }: Report): boolean {
  return Boolean(differences.aWithoutB.linearSplit || differences.bWithoutA.linearSplit);
}

/** Explains linear splitting, and why it may have negative variance. */
export const SPLITTING_SENTENCES =
  "Linear splitting (Hall, Marshall & Martin 2000) treats a model as a mixture of A∩B, with its weight, and a Gaussian remainder: mean and covariance of the remainder then follow without draws. " +
  "The model is not such a mixture. In directions where A∩B has more variance than the mixture allows, the remainder gets negative variance, which no distribution has; the larger the negative share, the less the remainder describes shapes.";

/** How test shapes are placed, in words. */
export const PLACEMENTS: Record<Placement, string> = {
  fit: "moved along with the fit",
  mean: "moved onto the mean",
  given: "placed as they are given",
};

const METHODS: Record<Evaluation["method"], (evaluation: Evaluation) => string> = {
  test: ({ shapes, placement }) =>
    `${count(shapes)} test ${shapes === 1 ? "shape" : "shapes"} that the model was not computed from, ${PLACEMENTS[placement]}.`,
  "leave-one-out": ({ shapes }) =>
    `The ${count(shapes)} training shapes: each is left out in turn and the model computed from the others.`,
  folds: ({ shapes, folds }) =>
    `The ${count(shapes)} training shapes, in ${folds} parts: each part is left out in turn and the model computed from the rest.`,
};

export function methodSentence(evaluation: Evaluation): string {
  return METHODS[evaluation.method](evaluation);
}

export function evaluationSentence(evaluation: Evaluation, name: string, unit: string): string {
  const { modes, generalization, specificity } = evaluation;
  const [most, near, far] = [modes.at(-1), generalization.at(-1), specificity.at(-1)];
  if (most === undefined || near === undefined || far === undefined) {
    return "The model has no modes to evaluate.";
  }
  return `With ${count(most)} ${most === 1 ? "mode" : "modes"} ${name} comes to within ${length(near, unit)} of a shape that it was not computed from (generalization), and its random shapes lie ${length(far, unit)} from the nearest of these shapes (specificity), both on average; smaller is better.`;
}

export function shareSentence(nouns: Nouns): string {
  return `How much of the variance of ${nouns.a} lies in directions that ${nouns.b} has too, and the other way round. No shape of the other model can have the rest.`;
}
