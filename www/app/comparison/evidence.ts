/** Sentences about whether the two groups of training shapes differ by more than chance, each for every outcome. Pure. */
import type { EvidenceReport, Hypothesis, Statistic, StatisticName } from "../../worker/protocol";
import { count, length, listed, number, percent } from "../text/format";
import { type Phrase, reported } from "../text/phrase";
import { pText } from "./answer";

/** Chance of a false alarm that is accepted, over all statistics of a hypothesis together. */
const LEVEL = 0.05;
/** Relabellings that the page advises. */
const ENOUGH = 999;
/** Standard errors within which a p is on no certain side of the level. */
const ERRORS = 2;

/** What relabelling says of a hypothesis; “too few” are relabellings that could not contradict it whatever the shapes. */
export type Outcome = "differs" | "chance" | "too-few";

export type HypothesisName = "onePopulation" | "oneCovariance";
export const HYPOTHESES: HypothesisName[] = ["onePopulation", "oneCovariance"];

interface Question {
  question: string;
  /** What is relabelled. */
  about: string;
  /** First words of the answer. */
  answers: Record<"differs" | "chance", string>;
}

export const QUESTIONS: Record<HypothesisName, Question> = {
  onePopulation: {
    question: "Are both groups of one population?",
    about:
      "All shapes are divided at random into two groups of the same sizes, again and again; every difference counts.",
    answers: { differs: "No", chance: "They may be" },
  },
  oneCovariance: {
    question: "Do they vary alike about means that may differ?",
    about:
      "The means stay as they are; the deviations from them are divided at random into two groups, again and again: only how the shapes vary counts. Exact for Gaussian populations, else approximate.",
    answers: { differs: "No", chance: "They may" },
  },
};

/** Names of the statistics of the permutation tests. */
export const STATISTICS: Record<StatisticName, string> = {
  means: "Distance of the means",
  varianceAOutsideB: "Variance of A outside B",
  varianceBOutsideA: "Variance of B outside A",
  distanceAToB: "Distance of A’s shapes to B",
  distanceBToA: "Distance of B’s shapes to A",
  totalVariances: "Ratio of the total variances, |log|",
  principalAngles: "Sum of the squared principal angles",
};

/** Names of the statistics in a sentence. */
export const IN_A_SENTENCE: Record<StatisticName, string> = {
  means: "the distance of the means",
  varianceAOutsideB: "the variance of A outside B",
  varianceBOutsideA: "the variance of B outside A",
  distanceAToB: "the distance of A’s shapes to B",
  distanceBToA: "the distance of B’s shapes to A",
  totalVariances: "the ratio of the total variances",
  principalAngles: "the principal angles",
};

/** The value of a statistic with its unit. */
export function statisticText(name: StatisticName, value: number, unit: string): string {
  if (name === "means" || name === "distanceAToB" || name === "distanceBToA") {
    return length(value, unit);
  }
  if (name === "varianceAOutsideB" || name === "varianceBOutsideA") return percent(value);
  return name === "principalAngles" ? `${number(value)}\u202frad²` : number(value);
}

export function outcome(hypothesis: Hypothesis): Outcome {
  if (hypothesis.statistics.some(({ pAdjusted }) => pAdjusted <= LEVEL)) return "differs";
  return leastAdjusted(hypothesis) > LEVEL ? "too-few" : "chance";
}

/** The smallest adjusted p that so many relabellings can give. */
function leastAdjusted({ statistics, permutations, exhaustive }: Hypothesis): number {
  return Math.min(1, statistics.length / (exhaustive ? permutations : 1 + permutations));
}

/** The statistic with the smallest adjusted p, and its place. */
function strongest({ statistics }: Hypothesis): { one: Statistic; index: number } | null {
  const least = Math.min(...statistics.map(({ p }) => p));
  const index = statistics.findIndex(({ p }) => p === least);
  const one = statistics[index];
  return one ? { one, index } : null;
}

/** What to bear in mind about the answer, if there is anything. */
export function caution({
  sharedShapes,
  onePopulation,
  oneCovariance,
}: EvidenceReport): string | null {
  if (sharedShapes > 0 || outcome(onePopulation) !== "chance") return null;
  return outcome(oneCovariance) === "differs"
    ? "About their means, though, they vary differently: see the second question."
    : "Two random groups of one population would differ as much. A difference that is small for so many shapes may go unseen.";
}

/** The answer to the question of a hypothesis, with the smallest p and its error. */
export function hypothesisSentence(evidence: EvidenceReport, name: HypothesisName): Phrase {
  const hypothesis = evidence[name];
  const found = strongest(hypothesis);
  if (!found) return ["There is nothing to compare."];
  const said = outcome(hypothesis);
  if (said === "too-few") return tooFew(hypothesis, name);
  const significant = hypothesis.statistics.filter(({ pAdjusted }) => pAdjusted <= LEVEL);
  const which =
    said === "differs"
      ? `: ${listed(significant.map((one) => IN_A_SENTENCE[one.name]))} ${areMany(significant) ? "are" : "is"} larger than relabelling gives`
      : `: none of the ${hypothesis.statistics.length} statistics is larger than relabelling gives`;
  return [
    QUESTIONS[name].answers[said],
    which,
    ". ",
    ...smallest(hypothesis, name, found),
    ...(isUncertain(found.one)
      ? [
          " The Monte-Carlo error leaves open on which side of 0.05 it is: ask for more relabellings.",
        ]
      : []),
  ];
}

const areMany = (of: Statistic[]) => of.length > 1 || of[0]?.name === "principalAngles";

function smallest(
  { permutations, exhaustive, statistics }: Hypothesis,
  name: HypothesisName,
  { one, index }: { one: Statistic; index: number },
): Phrase {
  const path = `evidence.${name}.statistics.${index}`;
  const many = reported(`evidence.${name}.permutations`, permutations, count(permutations));
  return [
    "Smallest adjusted p (Holm, ",
    `${statistics.length} statistics) `,
    reported(`${path}.pAdjusted`, one.pAdjusted, pText(one.pAdjusted)),
    `, of ${IN_A_SENTENCE[one.name]}; before adjustment `,
    reported(`${path}.p`, one.p, pText(one.p)),
    ...(exhaustive
      ? [", exact, of all ", many, " relabellings."]
      : [
          " ± ",
          reported(`${path}.pError`, one.pError, pText(one.pError)),
          ", of ",
          many,
          " relabellings.",
        ]),
  ];
}

function tooFew(hypothesis: Hypothesis, name: HypothesisName): Phrase {
  const { permutations, exhaustive } = hypothesis;
  const many = reported(`evidence.${name}.permutations`, permutations, count(permutations));
  const least = pText(leastAdjusted(hypothesis));
  return exhaustive
    ? [
        "Cannot be said: there are only ",
        many,
        ` ways to relabel so few shapes, and their smallest adjusted p is ${least}. Add shapes.`,
      ]
    : [
        "Cannot be said: of ",
        many,
        ` relabellings the smallest adjusted p is ${least}. Set Relabellings to ${ENOUGH}.`,
      ];
}

/** Whether other random relabellings might have put the adjusted p on the other side of the level. */
function isUncertain({ p, pError, pAdjusted }: Statistic): boolean {
  const error = p > 0 ? (pError * pAdjusted) / p : 0;
  return Math.abs(pAdjusted - LEVEL) < ERRORS * error;
}

/** One statistic beside its chance. */
export function statisticSentence(
  evidence: EvidenceReport,
  name: HypothesisName,
  index: number,
  unit: string,
): Phrase {
  const one = evidence[name].statistics[index];
  if (!one) return [];
  const path = `evidence.${name}.statistics.${index}`;
  const { chance } = one;
  const show = (value: number) => statisticText(one.name, value, unit);
  const many = evidence[name].statistics.length;
  const judged =
    one.pAdjusted <= LEVEL
      ? "More than chance: "
      : one.observed > chance.p95
        ? `Not more than chance for one of ${many} statistics: `
        : one.observed < chance.p05
          ? "Less than chance: "
          : "Within chance: ";
  return [
    judged,
    reported(`${path}.observed`, one.observed, show(one.observed)),
    ", by chance ",
    reported(`${path}.chance.p05`, chance.p05, show(chance.p05).replace(`\u202f${unit}`, "")),
    " to ",
    reported(`${path}.chance.p95`, chance.p95, show(chance.p95)),
    "; adjusted p ",
    reported(`${path}.pAdjusted`, one.pAdjusted, pText(one.pAdjusted)),
    ".",
  ];
}
