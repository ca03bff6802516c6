/** What a report says, in plain words. Pure: no DOM, no engine. */
import type { Progress, Report, SamplerName } from "../worker/protocol";
import { count, length, number, percent, plusMinus } from "./format";
import { figure, type Phrase } from "./phrase";

export interface Nouns {
  a: string;
  b: string;
}

/** The thresholds of src/report.rs. */
const R_HAT = 1.01;
const ESS = 400;

/** From here on “nearly everything” is a fair word. */
const NEARLY_ALL = 0.99;

export function headline(report: Report, nouns: Nouns): Phrase {
  const { varianceOfAInB, varianceOfBInA } = report.overlap;
  return [
    `${capital(nouns.b)} can make `,
    figure("overlap.varianceOfAInB", varianceOfAInB, percent(varianceOfAInB)),
    ` of the variance of ${nouns.a}; the other way round it is `,
    figure("overlap.varianceOfBInA", varianceOfBInA, percent(varianceOfBInA)),
    ".",
  ];
}

export function shared(report: Report): Phrase {
  const { meanDistance, vertexSd } = report.intersection;
  const unit = report.models.a.unit;
  const [a, b] = [report.models.a.vertexSd.mean, report.models.b.vertexSd.mean];
  const away = plusMinus(meanDistance.mean, meanDistance.sd);
  return [
    "A shape that both can make lies ",
    figure("intersection.meanDistance.mean", meanDistance.mean, away.mean),
    " ± ",
    figure("intersection.meanDistance.sd", meanDistance.sd, `${away.spread}\u202f${unit}`),
    " from the nearest shape of the other model. Its points vary by ",
    figure("intersection.vertexSd.mean", vertexSd.mean, length(vertexSd.mean, unit)),
    " on average, against ",
    figure("models.a.vertexSd.mean", a, number(a)),
    " in A and ",
    figure("models.b.vertexSd.mean", b, number(b)),
    " in B.",
  ];
}

export function differences(report: Report, nouns: Nouns): Phrase {
  const a = report.differences.aWithoutB.probability;
  const b = report.differences.bWithoutA.probability;
  const ofA = figure("differences.aWithoutB.probability", a, percent(a));
  const ofB = figure("differences.bWithoutA.probability", b, percent(b));
  if (Math.min(a, b) >= NEARLY_ALL) {
    return [
      ofA,
      ` of ${nouns.a} and `,
      ofB,
      ` of ${nouns.b} lie further than σ from the other model: at this σ nearly everything differs.`,
    ];
  }
  if (Math.max(a, b) <= 1 - NEARLY_ALL) {
    return [
      "At this σ almost nothing differs: only ",
      ofA,
      ` of ${nouns.a} and `,
      ofB,
      ` of ${nouns.b} are out of the other’s reach.`,
    ];
  }
  return [
    ofA,
    ` of ${nouns.a} are out of B’s reach at this σ, and `,
    ofB,
    ` of ${nouns.b} out of A’s.`,
  ];
}

export function spaces(report: Report): Phrase {
  const angles = report.overlap.principalAnglesDegrees;
  const first = angles[0];
  const last = angles.at(-1);
  const { meanToMean } = report.overlap;
  const sentence: Phrase = [
    "The two mean shapes are ",
    figure("overlap.meanToMean", meanToMean, length(meanToMean, report.models.a.unit)),
    " apart per point.",
  ];
  if (first === undefined || last === undefined) return sentence;
  return [
    ...sentence,
    " The directions of change they have most in common differ by ",
    figure("overlap.principalAnglesDegrees.0", first, `${number(first, 2)}°`),
    ", those least so by ",
    figure(`overlap.principalAnglesDegrees.${angles.length - 1}`, last, `${number(last, 2)}°`),
    ".",
  ];
}

export function belief(report: Report): { converged: boolean; phrase: Phrase } {
  const { converged, rHatMax, essBulkMin } = report.intersection.diagnostics;
  const evidence: Phrase = [
    ...(rHatMax === null
      ? []
      : ["R-hat ", figure("intersection.diagnostics.rHatMax", rHatMax, rHatMax.toFixed(4)), ", "]),
    "at least ",
    figure("intersection.diagnostics.essBulkMin", essBulkMin, count(essBulkMin)),
    " effective draws for every mode",
  ];
  const phrase: Phrase = converged
    ? ["Converged: ", ...evidence, "."]
    : ["Not converged yet: ", ...evidence, ". Ask for more draws before quoting these numbers."];
  return { converged, phrase };
}

/** While running: whether what is there so far could be believed. */
export function liveBelief(progress: Progress): string {
  const { rHatMax, essBulkMin } = progress;
  if (rHatMax === null && essBulkMin === null) return "waiting for the first draws";
  const settled = (rHatMax ?? 1) < R_HAT && (essBulkMin ?? 0) >= ESS;
  return settled ? "converged" : "not converged yet";
}

const STAGES: Record<Progress["stage"], string> = {
  prepare: "Preparing",
  fit: "First guess of A∩B",
  intersection: "Sampling A∩B",
  differences: "Sampling A∖B and B∖A",
  measure: "Measuring",
  done: "Finishing",
};

export function stageName(stage: Progress["stage"]): string {
  return STAGES[stage];
}

/** Seconds left, once there is something to judge by. */
export function secondsLeft(fraction: number, seconds: number): number | null {
  return fraction < 0.03 || seconds < 0.5 ? null : (seconds * (1 - fraction)) / fraction;
}

const SAMPLER_WORDS: Record<SamplerName, string> = {
  independence: "independence sampler",
  paper: "paper’s random walk",
  "paper-corrected": "paper’s walk, corrected",
};

export function settingsSentence(report: Report): string {
  const { sigma, sigmaRecommended, sampler, chains, draws, seed, align, modes } = report.settings;
  const unit = report.models.a.unit;
  const parts = [
    `σ ${sigma === null ? "recommended" : length(sigma, unit)}${sigmaRecommended ? " (recommended)" : ""}`,
    SAMPLER_WORDS[sampler],
    `${chains} chains`,
    `${count(draws)} draws a side`,
    `seed ${seed}`,
  ];
  if (modes !== null) parts.push(`first ${modes} modes`);
  if (align !== "none") parts.push(align === "rigid" ? "rigidly aligned" : "aligned with scale");
  return parts.join(" · ");
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
