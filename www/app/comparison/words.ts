/**
 * Writes the sentences of the results from a report: overlap, differences, convergence, accuracy. Pure: no DOM, no
 * engine.
 */
import type {
  DifferenceDefinition,
  FitMethod,
  InferenceReport,
  Inspection,
  KnownShapes,
  ModeDiagnostics,
  ModelReport,
  Origin,
  Progress,
  Report,
  Sampler,
  Sides,
} from "../../worker/protocol";
import type { Nouns } from "../state/demos";
import { completed, preparationWords, UNSTATED } from "../state/preparation";
import { DIFFERENCE_OF, letters } from "../state/regions";
import { SIGMA_SINCE } from "../state/settings";
import type { ReadProgress } from "../state/state";
import {
  bytes,
  capital,
  count,
  degrees,
  length,
  listed,
  number,
  percent,
  plusMinus,
} from "../text/format";
import { type Phrase, reported } from "../text/phrase";
import { said } from "./answer";

/** The thresholds of src/report.rs. */
export const R_HAT = 1.01;
export const ESS = 400;

/** Share of a model outside the other from which on the page says “nearly everything differs”. */
const NEARLY_ALL = 0.99;

/** The first sentence: how far a shape of A lies from B, of any σ; in older reports the shared variance. */
export function headline(report: Report, nouns: Nouns): Phrase {
  return said(report, nouns, "reach-of-a") ?? variances(report, nouns);
}

/** How much of the variance of each the other model can make. */
export function variances(report: Report, nouns: Nouns): Phrase {
  const { varianceOfAInB, varianceOfBInA } = report.overlap;
  return [
    `About their own mean, ${nouns.modelB} holds `,
    reported("overlap.varianceOfAInB", varianceOfAInB, percent(varianceOfAInB)),
    ` of how ${nouns.shapesOfA} vary, ${nouns.modelA} `,
    reported("overlap.varianceOfBInA", varianceOfBInA, percent(varianceOfBInA)),
    ` of how ${nouns.shapesOfB} do.`,
  ];
}

/** Distances below this share of the size are rounding. */
const ROUNDING = 1e-9;

/** Mean distance of A∩B to the other model, in σ, up to which the page says that both can make its shapes. */
const WITHIN = 2;

export function shared(report: Report): Phrase {
  const { meanDistance, vertexSd } = report.intersection;
  const unit = report.models.a.unit;
  const [a, b] = [report.models.a.vertexSd.mean, report.models.b.vertexSd.mean];
  const rounding = meanDistance.mean <= ROUNDING * report.models.a.size;
  const away = rounding
    ? { mean: "0", spread: "0" }
    : plusMinus(meanDistance.mean, meanDistance.sd);
  const plausible = report.warnings.every(({ code }) => code !== "implausible-intersection");
  const near = meanDistance.mean <= WITHIN * (report.settings.sigma ?? Number.POSITIVE_INFINITY);
  const meet = near && plausible;
  return [
    meet
      ? "A shape that both can make lies "
      : plausible
        ? "The shapes that come nearest to both lie "
        : "No plausible shape is in both. Those of A∩B, far out in each, lie ",
    reported("intersection.meanDistance.mean", meanDistance.mean, away.mean),
    " ± ",
    reported("intersection.meanDistance.sd", meanDistance.sd, `${away.spread}\u202f${unit}`),
    meet ? " from the nearest shape of the other model. Its" : " from the other model. Their",
    " points vary by ",
    reported("intersection.vertexSd.mean", vertexSd.mean, length(vertexSd.mean, unit)),
    " on average, against ",
    reported("models.a.vertexSd.mean", a, number(a)),
    " in A and ",
    reported("models.b.vertexSd.mean", b, number(b)),
    " in\u202fB.",
  ];
}

export function differences(report: Report, nouns: Nouns): Phrase {
  const a = report.differences.aWithoutB.probability;
  const b = report.differences.bWithoutA.probability;
  const ofA = reported("differences.aWithoutB.probability", a, percent(a));
  const ofB = reported("differences.bWithoutA.probability", b, percent(b));
  const { aWithoutB, bWithoutA } = report.differences;
  // A cancelled run may have drawn no difference, or only one: 0 % is no result then.
  const cancelled = report.warnings.some(({ code }) => code === "cancelled");
  if (cancelled && bWithoutA.diagnostics.evaluations === 0) {
    if (aWithoutB.diagnostics.evaluations === 0) {
      return ["The run was ended before the differences were drawn."];
    }
    return [ofA, ` of ${nouns.shapesOfA} are in A∖B; the run was ended before B∖A was drawn.`];
  }
  const each: Phrase = [ofA, ` of ${nouns.shapesOfA} and `, ofB, ` of ${nouns.shapesOfB}`];
  const definition = report.settings.difference ?? "soft";
  if (definition !== "soft") {
    return ["The differences contain ", ...each, `: those ${HARD[definition]}.`];
  }
  if (nearlyAllDiffers(report)) {
    return [
      ...each,
      " lie further than σ from the other model: at this σ nearly everything differs. ",
      "Choose a larger σ to see what is special to one of them.",
    ];
  }
  const { aToB, bToA } = report.reach ?? {};
  if (aToB?.mean === 0 && bToA?.mean === 0) {
    return [
      ...each,
      " cannot be made by the other model, at any σ: each spans the shapes of the other.",
    ];
  }
  if (Math.max(a, b) <= 1 - NEARLY_ALL) {
    return [
      "At this σ almost nothing differs: only ",
      ...each,
      " cannot be made by the other model.",
    ];
  }
  return [...each, " cannot be made by the other model at this σ."];
}

const HARD: Record<Exclude<DifferenceDefinition, "soft">, string> = {
  distance: "that lie farthest from the other model",
  relative: "of whose deviation from the mean the other model misses the largest part",
  outside: "whose nearest shape in the other model is least plausible there",
};

export type DifferencePicture = DifferenceDefinition | "exclusiveModes";

/** Names and explanations of the definitions of a difference. */
export const DEFINITIONS: Record<DifferencePicture, { label: string; help: string }> = {
  soft: {
    label: "paper’s",
    help: "A shape of A is in the difference with probability 1 − exp(−½(d/σ)²), d its distance to the nearest shape of B.",
  },
  distance: {
    label: "beyond a distance",
    help: "A shape of A is in the difference if its distance to the nearest shape of B is above a threshold.",
  },
  relative: {
    label: "relative",
    help: "A shape of A is in the difference if its distance to the nearest shape of B, divided by its distance to A’s mean, is above a threshold.",
  },
  outside: {
    label: "outside Q₂",
    help: "A shape of A is in the difference if its nearest shape of B is implausible in B: more standard deviations from B’s mean than a threshold.",
  },
  exclusiveModes: {
    label: "exclusive modes",
    help: "Not random draws: the directions of A that B misses most, in order, each at +3 standard deviations.",
  },
};

/** Overlap of a difference with its model from which on the page says that they are nearly the same. */
const SAME_AS_MODEL = 0.95;

/** Warns that the paper's difference is nearly the whole model; null if it is not. */
export function nearlyTheModel(report: Report): Phrase | null {
  if ((report.settings.difference ?? "soft") !== "soft") return null;
  const { aWithoutB, bWithoutA } = report.differences;
  const [a, b] = [aWithoutB.overlapWithPrior ?? 0, bWithoutA.overlapWithPrior ?? 0];
  const ofA = reported("differences.aWithoutB.overlapWithPrior", a, percent(a));
  const ofB = reported("differences.bWithoutA.overlapWithPrior", b, percent(b));
  const same = (overlap: number) => overlap > SAME_AS_MODEL;
  if (!same(a) && !same(b)) return null;
  const which: Phrase =
    same(a) && same(b)
      ? ["each model: ", ofA, " like A, ", ofB, " like B."]
      : same(a)
        ? ["A: ", ofA, " like it."]
        : ["B: ", ofB, " like it."];
  return ["At this σ the paper’s difference is nearly all of ", ...which];
}

/** Share of variance that the other model misses, and the largest exclusive modes; null for an older report. */
export function exclusive(report: Report, side: "a" | "b"): Phrase | null {
  const key = DIFFERENCE_OF[side];
  const found = report.differences[key].exclusive;
  if (!found) return null;
  const path = `differences.${key}.exclusive`;
  const [own, other] = letters(side);
  const strongest = found.residualSd.slice(0, 3);
  const sentence: Phrase = [
    `${other} misses `,
    reported(`${path}.unexplained`, found.unexplained, percent(found.unexplained)),
    ` of the variance of ${own}`,
  ];
  if (strongest.length === 0) return [...sentence, "."];
  return [
    ...sentence,
    ...strongest.flatMap(
      (sd, i): Phrase => [
        i === 0 ? "; its strongest exclusive modes by " : ", ",
        reported(`${path}.residualSd.${i}`, sd, number(sd)),
      ],
    ),
    `\u202f${report.models.a.unit} per standard deviation.`,
  ];
}

function nearlyAllDiffers(report: Report): boolean {
  const { aWithoutB, bWithoutA } = report.differences;
  const soft = (report.settings.difference ?? "soft") === "soft";
  return soft && Math.min(aWithoutB.probability, bWithoutA.probability) >= NEARLY_ALL;
}

/** Where a σ comes from that versions before this rule chose otherwise. */
const NEW_SOURCES: Partial<Record<NonNullable<Report["sigmaSource"]>, string>> = {
  "left-out": "the mean distance of training shapes to the model of the others",
  noise: "how far true members lie from their own model",
  meeting: "the least distance of plausible shapes of the two",
};

/** Says that a link without σ may have meant that of an older version; null where that is the same. */
export function olderSigma(report: Report): { message: string; hint: string } | null {
  const { sigma } = report.settings;
  const source = report.sigmaSource && NEW_SOURCES[report.sigmaSource];
  if (!source || sigma === null) return null;
  return {
    message: `This link may be from a version before ${SIGMA_SINCE}, which chose σ as a quarter of the range of distances. It now gives σ = ${length(sigma, report.models.a.unit)}, ${source}.`,
    hint: "To keep a σ, type it in the settings: the link then has it.",
  };
}

/** The warnings of a report that are not already stated by the sentences above. */
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
    reported("overlap.meanToMean", meanToMean, length(meanToMean, report.models.a.unit)),
    " apart, on average over the points.",
  ];
  if (first === undefined || last === undefined) return sentence;
  return [
    ...sentence,
    " The smallest principal angle between their modes is ",
    reported("overlap.principalAnglesDegrees.0", first, degrees(first)),
    ", the largest ",
    reported(`overlap.principalAnglesDegrees.${angles.length - 1}`, last, degrees(last)),
    ".",
  ];
}

/** Whether the draws converged, as the engine decided, with the diagnostics that show it. */
export function belief(report: Report): { converged: boolean; phrase: Phrase } {
  const { converged, rHatMax, essBulkMin, paretoK, importanceEss } =
    report.intersection.diagnostics;
  const path = "intersection.diagnostics";
  const chains: Phrase = [
    ...(rHatMax === null
      ? []
      : ["R-hat ", reported(`${path}.rHatMax`, rHatMax, rHatMax.toFixed(4)), ", "]),
    "at least ",
    reported(`${path}.essBulkMin`, essBulkMin, count(essBulkMin)),
    " effective draws for every mode",
  ];
  const byChains = (rHatMax ?? 1) < R_HAT && essBulkMin >= ESS;
  const weights: Phrase =
    paretoK === null || importanceEss == null
      ? []
      : [
          "Pareto k ",
          reported(`${path}.paretoK`, paretoK, number(paretoK, 2)),
          ", effective size of the weights ",
          reported(`${path}.importanceEss`, importanceEss, count(importanceEss)),
        ];
  // The diagnostics that met their limits; all of them if it has not converged.
  let evidence = chains;
  if (weights.length > 0 && !converged) evidence = [...chains, "; ", ...weights];
  if (weights.length > 0 && converged && !byChains) evidence = weights;
  const phrase: Phrase = converged
    ? ["Converged: ", ...evidence, "."]
    : ["Not converged yet: ", ...evidence, ". Ask for more draws before quoting these numbers."];
  return { converged, phrase };
}

/**
 * Whether the draws of a run in progress look converged. During a run the engine computes the diagnostics of the
 * first modes only; the report covers all of them.
 */
export function liveBelief(progress: Progress): string {
  const { rHatMax, essBulkMin } = progress;
  if (rHatMax === null && essBulkMin === null) return "waiting for the first draws";
  const settled = (rHatMax ?? 1) < R_HAT && (essBulkMin ?? 0) >= ESS;
  return settled ? LOOKS_WELL : "not converged yet";
}

export const LOOKS_WELL = "diagnostics are fine so far, all modes are checked at the end";

const MOMENTS: Record<InferenceReport["moments"], string> = {
  "closed-form":
    "mean and variance come from the fit in closed form; the correction by weighted draws is below its standard error",
  weighted:
    "mean and variance are those of the Gaussian fit, corrected by weighted draws and gradients",
  draws: "mean and variance are those of the draws",
};

const FIT_WORDS: Record<FitMethod, string> = {
  variational: "variational",
  reweighted: "reweighted",
  laplace: "Laplace",
  rms: "RMS",
};

/** Which sampler ran for a model, why, and how mean and variance were computed. */
export function inferred(report: Report, side: "a" | "b"): string | null {
  const found = report.intersection.inference?.[side];
  if (!found) return null;
  const reason = found.reason.trim().replace(/[.\s]+$/, "");
  return (
    `${capital(SAMPLER_WORDS[found.sampler] ?? found.sampler)}` +
    `${reason === "" ? "" : `: ${reason}`}. ` +
    `Built on the ${FIT_WORDS[found.fit] ?? found.fit} fit; ${MOMENTS[found.moments] ?? found.moments}.`
  );
}

interface Worst {
  mode: number;
  side: "a" | "b";
  value: number;
}

/** The worst value of one diagnostic over all modes of both models; modes counted from 1. */
export function worstMode(
  both: Sides<ModeDiagnostics>,
  which: "rHat" | "essBulk" | "essTail",
): Worst | null {
  let worst: Worst | null = null;
  for (const side of ["a", "b"] as const) {
    for (const [i, value] of both[side][which].entries()) {
      const worse =
        which === "rHat"
          ? (found: Worst) => value > found.value
          : (found: Worst) => value < found.value;
      if (Number.isFinite(value) && (worst === null || worse(worst))) {
        worst = { mode: i + 1, side, value };
      }
    }
  }
  return worst;
}

export function worstModes(report: Report): Phrase | null {
  const both = report.intersection.coefficients;
  if (!both) return null;
  const named = (
    which: "rHat" | "essBulk" | "essTail",
    text: (value: number) => string,
  ): Phrase => {
    const found = worstMode(both, which);
    if (!found) return [];
    const path = `intersection.coefficients.${found.side}.${which}.${found.mode - 1}`;
    return [
      reported(path, found.value, text(found.value)),
      ` for mode\u00a0${found.mode} of ${found.side.toUpperCase()}`,
    ];
  };
  const rHat = named("rHat", (value) => value.toFixed(4));
  const bulk = named("essBulk", count);
  const tail = named("essTail", count);
  if (bulk.length === 0) return null;
  return [
    ...(rHat.length === 0 ? ["Worst: "] : ["Worst R-hat ", ...rHat, "; "]),
    "fewest effective draws ",
    ...bulk,
    ...(tail.length === 0 ? [] : [", in the tails ", ...tail]),
    ".",
  ];
}

/**
 * Standard error of a mode's direction from which on the mode is not determined alone, in radians; as in src/report.rs.
 */
const MOST_TURN = 0.2;

/** Groups of neighbouring modes that are not determined one by one, counted from 1. */
export function unsettledModes(turns: number[]): number[][] {
  const runs: number[][] = [];
  turns.forEach((turn, i) => {
    if (turn <= MOST_TURN) return;
    const last = runs.at(-1);
    if (last?.at(-1) === i) last.push(i + 1);
    else runs.push([i + 1]);
  });
  return runs;
}

/** Names the modes whose variances are too close to determine them one by one; null if there are none. */
export function unsettled(report: Report): string | null {
  const turns = report.intersection.accuracy?.modeTurns ?? [];
  const runs = unsettledModes(turns);
  const first = runs[0];
  if (!first) return null;
  const [from = 0, next] = first;
  const last = first.at(-1) ?? from;
  const also =
    runs.length === 1 ? "" : ` The same holds for ${listed(runs.slice(1).map(runName))}.`;
  if (next === undefined) {
    return `Mode ${from} is not determined well: its direction may turn by more than ${Math.round((MOST_TURN * 180) / Math.PI)}°.${also}`;
  }
  if (first.length === 2) {
    return `Modes ${from} and ${next} have nearly equal variance: only the two together are determined.${also}`;
  }
  return `Modes ${from} to ${last} have nearly equal variances: only all of them together are determined.${also}`;
}

function runName(run: number[]): string {
  const [from, next] = run;
  if (next === undefined) return `mode ${from}`;
  return run.length === 2 ? `modes ${from} and ${next}` : `modes ${from} to ${run.at(-1)}`;
}

/** Relative difference of the two covariances from which on they describe different sets of shapes. */
const DISAGREE = 0.5;

export function sidesDisagree(report: Report): boolean {
  return (report.intersection.disagreement?.covariance ?? 0) > DISAGREE;
}

/** How much the intersection models from A alone and from B alone differ; null for an older report. */
export function twoSides(report: Report): Phrase | null {
  const found = report.intersection.disagreement;
  if (!found) return null;
  const path = "intersection.disagreement";
  return [
    "The shapes of A near B and those of B near A give two models; A∩B is made of both in equal shares. Their means are ",
    reported(
      `${path}.meanToMean`,
      found.meanToMean,
      length(found.meanToMean, report.models.a.unit),
    ),
    " apart, their covariances differ by ",
    reported(`${path}.covariance`, found.covariance, percent(found.covariance)),
    sidesDisagree(report)
      ? ": they describe different sets of shapes. Look at each alone before you use A∩B."
      : ".",
  ];
}

const STAGES: Record<Progress["stage"], string> = {
  prepare: "Preparing",
  fit: "Gaussian fit of A∩B",
  intersection: "Sampling A∩B",
  differences: "Sampling A∖B and B∖A",
  measure: "Measuring",
  evidence: "Relabelling training shapes",
  done: "Finishing",
};

export function stageName(stage: Progress["stage"]): string {
  return STAGES[stage];
}

/** Estimated seconds until a run is finished; null at its beginning. */
export function secondsLeft(fraction: number, seconds: number): number | null {
  return fraction < 0.03 || seconds < 0.5 ? null : (seconds * (1 - fraction)) / fraction;
}

const SAMPLER_WORDS: Record<Sampler, string> = {
  auto: "automatic sampler",
  variational: "Gaussian fit alone",
  independence: "independence sampler",
  hmc: "Hamiltonian Monte Carlo",
  mala: "Langevin steps",
  pcn: "Crank–Nicolson steps",
  paper: "paper’s random walk",
  "paper-corrected": "paper’s walk, corrected",
};

export function settingsSentence(report: Report): string {
  const { sigma, sigmaRecommended, sampler, chains, draws, seed, align, modes } = report.settings;
  const { pooling, plausibility, difference } = report.settings;
  const unit = report.models.a.unit;
  const parts = [
    `σ ${sigma === null ? "recommended" : length(sigma, unit)}${sigmaRecommended ? " (recommended)" : ""}`,
    SAMPLER_WORDS[sampler] ?? sampler,
    `${chains} chains`,
    `${count(draws)} draws per model`,
    `seed ${seed}`,
  ];
  if (pooling && pooling !== "both") parts.push(`from ${pooling.toUpperCase()} alone`);
  if (plausibility === "idempotent") parts.push("idempotent");
  if (difference && difference !== "soft") {
    parts.push(`difference ${DEFINITIONS[difference].label}`);
  }
  if (modes !== null) parts.push(`first ${modes} modes`);
  if (align !== "none") parts.push(align === "rigid" ? "rigidly aligned" : "aligned with scale");
  parts.push(...preparationWords(completed(report.settings.prepare)));
  return parts.join(" · ");
}

/** Progress of opening a file: bytes read, of how many. */
export function readingSentence(read: ReadProgress | null): string {
  if (read === null) return "Opening…";
  const does = read.arrives ? "Downloading" : "Reading";
  if (read.of === null) return `${does}: ${bytes(read.bytes)} so far`;
  if (read.bytes >= read.of && !read.arrives) return "Computing the model…";
  const of = bytes(read.of);
  const unit = of.slice(of.indexOf("\u202f"));
  const done = unit.endsWith("MB")
    ? number(read.bytes / 1e6)
    : String(Math.round(read.bytes / 1e3));
  return `${does} ${done} of ${of}`;
}

/** How a model was computed from shapes or blendshapes; null for one that was read from a file. */
export function originSentence(origin: Origin): string | null {
  switch (origin.kind) {
    case "file":
      return null;
    case "shapes":
      return `Computed here from ${count(origin.count)} shapes, aligned rigidly${origin.scaled ? " and scaled to one size" : ""}.`;
    case "blendshapes":
      return `Computed here from ${count(origin.count)} blendshapes, with ${count(origin.sampled)} sampled shapes.`;
  }
}

/** How many shapes are known with a model, and how they relate to it. */
export function shapesSentence({ count: shapes, role, name }: KnownShapes): string {
  const from = name === null ? "" : `, of “${name}”`;
  const kind = role === "test" ? "test" : "training";
  const within = role === "within-modes" ? ", known only within the modes of the file" : "";
  return `${count(shapes)} ${kind} shapes${from}${within}.`;
}

/** Says that a file states no unit, with a guess from the size of the mean shape. */
export function unitSentence(report: ModelReport): string | null {
  if (report.unit !== UNSTATED) return null;
  const guess = report.unitGuess ? `, probably ${report.unitGuess}` : "";
  return `Unit not stated${guess}.`;
}

/** Deviation from an orthonormal basis that single precision explains. */
const SINGLE_PRECISION = 1e-4;

export function basisSentence(report: ModelReport): string | null {
  const off = report.orthogonality ?? 0;
  const dropped = report.droppedModes ?? 0;
  const sentences: string[] = [];
  if (off > SINGLE_PRECISION)
    sentences.push(`Basis was not orthonormal (off by ${number(off, 2)}); corrected.`);
  if (dropped > 0) {
    sentences.push(`${count(dropped)} mode${dropped === 1 ? "" : "s"} without variance left out.`);
  }
  return sentences.length === 0 ? null : sentences.join(" ");
}

/** Points, faces and means of a pair that can be compared, in one line. */
export function pairLine(found: Inspection, unit: string): string {
  const { compared, points, triangles, meanDistance } = found;
  const same = points.a === points.b;
  const parts =
    compared === null
      ? [`${count(points.a)} and ${count(points.b)} points`]
      : [`${count(compared)} points ${same && compared === points.a ? "in common" : "compared"}`];
  if (triangles !== "unknown") parts.push(triangles === "same" ? "same faces" : "different faces");
  const apart = meanDistance.now ?? meanDistance.before;
  if (apart !== null) parts.push(apart === 0 ? "same mean" : `means ${length(apart, unit)} apart`);
  return parts.join(" · ");
}

/** Distance of the two means as they stand, after rigid alignment, and after alignment with scale. */
export function alignmentWords(found: Inspection, unit: string): string | null {
  const { before, rigid, similarity } = found.meanDistance;
  const parts: string[] = [];
  if (before !== null) parts.push(`${length(before, unit)} apart as they stand`);
  if (rigid !== null) parts.push(`${length(rigid, unit)} aligned rigidly`);
  if (similarity !== null) parts.push(`${length(similarity, unit)} with scale`);
  return parts.length === 0 ? null : parts.join(", ");
}
