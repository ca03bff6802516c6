/** What a report says, in plain words. Pure: no DOM, no engine. */
import type { Progress, Report, SamplerName } from "../worker/protocol";
import type { Nouns } from "./demos";
import { count, degrees, length, number, percent, plusMinus } from "./format";
import { figure, type Phrase } from "./phrase";

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

/** How far, in σ, a shape may lie from the other model for “both can make” to be a fair word. */
const WITHIN = 2;

export function shared(report: Report): Phrase {
  const { meanDistance, vertexSd } = report.intersection;
  const unit = report.models.a.unit;
  const [a, b] = [report.models.a.vertexSd.mean, report.models.b.vertexSd.mean];
  const away = plusMinus(meanDistance.mean, meanDistance.sd);
  const meet = meanDistance.mean <= WITHIN * (report.settings.sigma ?? Number.POSITIVE_INFINITY);
  return [
    meet ? "A shape that both can make lies " : "The shapes that come nearest to both lie ",
    figure("intersection.meanDistance.mean", meanDistance.mean, away.mean),
    " ± ",
    figure("intersection.meanDistance.sd", meanDistance.sd, `${away.spread}\u202f${unit}`),
    meet ? " from the nearest shape of the other model. Its" : " from the other model. Their",
    " points vary by ",
    figure("intersection.vertexSd.mean", vertexSd.mean, length(vertexSd.mean, unit)),
    " on average, against ",
    figure("models.a.vertexSd.mean", a, number(a)),
    " in A and ",
    figure("models.b.vertexSd.mean", b, number(b)),
    " in\u202fB.",
  ];
}

export function differences(report: Report, nouns: Nouns): Phrase {
  const a = report.differences.aWithoutB.probability;
  const b = report.differences.bWithoutA.probability;
  const ofA = figure("differences.aWithoutB.probability", a, percent(a));
  const ofB = figure("differences.bWithoutA.probability", b, percent(b));
  const each: Phrase = [ofA, ` of ${nouns.shapesOfA} and `, ofB, ` of ${nouns.shapesOfB}`];
  if (nearlyAllDiffers(report)) {
    return [
      ...each,
      " lie further than σ from the other model: at this σ nearly everything differs. ",
      "Choose a larger σ to see what is special to one of them.",
    ];
  }
  if (Math.max(a, b) <= 1 - NEARLY_ALL) {
    return ["At this σ almost nothing differs: only ", ...each, " are out of the other’s reach."];
  }
  return [...each, " are out of the other model’s reach at this σ."];
}

function nearlyAllDiffers(report: Report): boolean {
  const { aWithoutB, bWithoutA } = report.differences;
  return Math.min(aWithoutB.probability, bWithoutA.probability) >= NEARLY_ALL;
}

/** The warnings that the sentences above do not say already. */
export function furtherWarnings(report: Report): Report["warnings"] {
  const said = new Set(["not-converged"]);
  if (nearlyAllDiffers(report)) said.add("nearly-all-differs");
  return report.warnings.filter(({ code }) => !said.has(code));
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
    figure("overlap.principalAnglesDegrees.0", first, degrees(first)),
    ", those least so by ",
    figure(`overlap.principalAnglesDegrees.${angles.length - 1}`, last, degrees(last)),
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

/**
 * While running: whether what is there so far could be believed. The engine looks at the first
 * modes only then; the report judges all of them.
 */
export function liveBelief(progress: Progress): string {
  const { rHatMax, essBulkMin } = progress;
  if (rHatMax === null && essBulkMin === null) return "waiting for the first draws";
  const settled = (rHatMax ?? 1) < R_HAT && (essBulkMin ?? 0) >= ESS;
  return settled ? "converged so far" : "not converged yet";
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
