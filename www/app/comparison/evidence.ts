/** Sentences about whether the two groups of training shapes differ by more than chance, each for every outcome. Pure. */
import type {
  Band,
  EvidenceReport,
  Hypothesis,
  Report,
  Side,
  Statistic,
  StatisticName,
} from "../../worker/protocol";
import { count, length, number, percent } from "../text/format";
import { type Phrase, reported } from "../text/phrase";

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
const IN_A_SENTENCE: Record<StatisticName, string> = {
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

/** A p-value, with as many digits as it is judged by. */
export function pText(p: number): string {
  if (p >= 0.1) return p.toFixed(2);
  return p >= 0.0005 ? p.toFixed(3) : number(p, 1);
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

/** Whether two groups differ by more than chance, in one sentence; null for no answer. */
export function verdict(evidence: EvidenceReport): { differs: boolean | null; phrase: Phrase } {
  const { shapes, sharedShapes } = evidence;
  const counts: Phrase = [
    reported("evidence.shapes.a", shapes.a, count(shapes.a)),
    " shapes of A and ",
    reported("evidence.shapes.b", shapes.b, count(shapes.b)),
    " of B",
  ];
  if (sharedShapes > 0) {
    return {
      differs: null,
      phrase: [
        "Whether the groups differ by more than chance cannot be said, because shapes are in both: ",
        reported("evidence.sharedShapes", sharedShapes, count(sharedShapes)),
        " of ",
        ...counts,
        ".",
      ],
    };
  }
  switch (outcome(evidence.onePopulation)) {
    case "differs":
      return {
        differs: true,
        phrase: ["The groups differ by more than chance, as ", ...counts, " show."],
      };
    case "chance":
      return {
        differs: false,
        phrase: [
          "The groups differ by no more than chance: two random groups of one population would differ as much. With ",
          ...counts,
          " a small difference could go unseen.",
        ],
      };
    case "too-few":
      return {
        differs: null,
        phrase: [
          "Whether the groups differ by more than chance cannot be said of so few relabellings, of ",
          ...counts,
          ".",
        ],
      };
  }
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

/** How many left-out shapes of a group are nearer to the model of their own group. */
export function toldApartSentence(evidence: EvidenceReport, side: Side): Phrase {
  const { share, chance } = evidence.toldApart[side];
  const [own, other] = names(side);
  const shapes = evidence.shapes[side];
  const path = `evidence.toldApart.${side}`;
  const band: Phrase = [
    reported(`${path}.chance.mean`, chance.mean, percent(chance.mean)),
    " (5–95 %: ",
    reported(`${path}.chance.p05`, chance.p05, percent(chance.p05)),
    " to ",
    reported(`${path}.chance.p95`, chance.p95, percent(chance.p95)),
    ")",
  ];
  return [
    "In ",
    reported(`${path}.share`, share, String(Math.round(2 * share * shapes) / 2)),
    " of ",
    reported(`evidence.shapes.${side}`, shapes, count(shapes)),
    ` cases a left-out shape of ${own} is nearer to ${own}’s model than to ${other}’s; by chance in `,
    ...band,
    share > chance.p95
      ? `: shapes of ${own} can be told from those of ${other}.`
      : `: shapes of ${own} cannot be told from those of ${other}.`,
  ];
}

/** What the model of all others misses of a shape. */
export function leftOutSentence(evidence: EvidenceReport, unit: string): Phrase {
  const of = (side: Side): Phrase => {
    const { mean, standardDeviation } = evidence.leftOut[side];
    const path = `evidence.leftOut.${side}`;
    return [
      reported(`${path}.mean`, mean, number(mean)),
      " ± ",
      reported(`${path}.standardDeviation`, standardDeviation, length(standardDeviation, unit)),
    ];
  };
  return [
    "A shape of A lies ",
    ...of("a"),
    " from the model of the other shapes of A, one of B ",
    ...of("b"),
    " from that of B, on average over the points.",
  ];
}

/** Shares of variance at equal numbers of shapes; null for groups of one size. */
export function matchedSentence({ matched }: EvidenceReport): Phrase | null {
  if (!matched) return null;
  return [
    "With ",
    reported("evidence.matched.shapes", matched.shapes, count(matched.shapes)),
    " shapes of each group, ",
    reported(
      "evidence.matched.varianceAOutsideB",
      matched.varianceAOutsideB,
      percent(matched.varianceAOutsideB),
    ),
    " of the variance of A lies outside B, and ",
    reported(
      "evidence.matched.varianceBOutsideA",
      matched.varianceBOutsideA,
      percent(matched.varianceBOutsideA),
    ),
    " of that of B outside A.",
  ];
}

/** At how many points the means differ. */
export function pointsSentence({ vertices }: EvidenceReport): Phrase {
  const { differ, falseDiscovery } = vertices;
  const discovered: Phrase = [
    reported("evidence.vertices.falseDiscovery", falseDiscovery, percent(falseDiscovery)),
    " if one in twenty of these may be false.",
  ];
  if (differ === 0) {
    return [
      "The means differ at no point by more than chance (family-wise p ≤ 0.05), at ",
      ...discovered,
    ];
  }
  return [
    "The means differ at ",
    reported("evidence.vertices.differ", differ, percent(differ)),
    " of the points by more than chance (family-wise p ≤ 0.05), at ",
    ...discovered,
  ];
}

/** Overlap of the first mode below which not even that is stable: half way from chance to one. */
function isStable({ overlap, dimensions }: EvidenceReport["stability"][Side]): boolean {
  return (overlap[0] ?? 0) > 0.5 * (1 + 1 / dimensions) || overlap.length === 0;
}

/** How many modes of a group halves of it have in common. */
export function stabilitySentence(evidence: EvidenceReport, side: Side): Phrase {
  const found = evidence.stability[side];
  const name = side.toUpperCase();
  const modes = found.suggestedModes;
  const number = reported(`evidence.stability.${side}.suggestedModes`, modes, count(modes));
  if (modes === 1 && !isStable(found)) {
    return [
      `No mode of ${name} is stable: halves of its shapes have other first modes. Keep at least `,
      number,
      ", and add shapes.",
    ];
  }
  const first: Phrase =
    modes === 1
      ? ["Mode ", number, ` of ${name} is stable`]
      : ["Modes 1 to ", number, ` of ${name} are stable`];
  return modes >= found.overlap.length
    ? [...first, `: as many as halves of its shapes can show.`]
    : [...first, `; from ${count(modes + 1)} on they are chance.`];
}

/** Whether an observed curve leaves the band of chance, on which side and how often. */
export function bandSentence({ observed, p05, p95 }: Band): string {
  const below = observed.filter((value, i) => value < (p05[i] ?? value)).length;
  const above = observed.filter((value, i) => value > (p95[i] ?? value)).length;
  const all = observed.length;
  if (below + above === 0) return "Inside the band of chance everywhere.";
  if (below === all) return "Below the band of chance everywhere.";
  if (above === all) return "Above the band of chance everywhere.";
  const parts = [
    ...(below > 0 ? [`below it at ${count(below)}`] : []),
    ...(above > 0 ? [`above it at ${count(above)}`] : []),
  ];
  return `Outside the band of chance at ${count(below + above)} of ${count(all)} places: ${parts.join(", ")}. By chance alone one in ten is outside.`;
}

/** Why there is no evidence, and what to do to get an answer. */
export function noEvidence(report: Report, cancelled: boolean): { message: string; hint: string } {
  if (report.settings.permutations === 0) {
    return {
      message:
        "Whether the difference is more than chance was not asked for: there are no relabellings.",
      hint: `Set Relabellings to ${ENOUGH} in the settings, under “More”.`,
    };
  }
  const unknown = (["a", "b"] as const).filter(
    (side) => report.models[side].trainingShapes == null,
  );
  if (unknown.length > 0) {
    const of = unknown.map((side) => side.toUpperCase()).join(" and ");
    const [model, was, folder] =
      unknown.length === 1 ? ["model", "was", "folder"] : ["models", "were", "folders"];
    return {
      message: `Whether the difference is more than chance cannot be said: the shapes from which ${model} ${of} ${was} made are not known.`,
      hint: `Drop the ${folder} of the shapes of ${of} in place of the ${model} (meshes or landmarks with the same points in the same order), or a file that has its training coefficients.`,
    };
  }
  if (cancelled) {
    return {
      message: "The run was ended before the shapes were relabelled.",
      hint: "Run it again to the end to see whether the difference is more than chance.",
    };
  }
  return {
    message:
      "Whether the difference is more than chance cannot be said: it takes at least 4 shapes of each group, and shapes that are not all the same.",
    hint: "Add shapes to the smaller group.",
  };
}

const names = (side: Side) => (side === "a" ? (["A", "B"] as const) : (["B", "A"] as const));

function listed(words: string[]): string {
  return words.length < 2 ? words.join("") : `${words.slice(0, -1).join(", ")} and ${words.at(-1)}`;
}
