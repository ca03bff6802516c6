/** Writes the methods paragraph of a paper and its BibTeX from a report. Pure; every number is the report's. */
import type { InferenceReport, Report, Sampler, Side, Sides, Topic } from "../../worker/protocol";
import { nounsOf } from "../state/demos";
import { completed, preparationWords } from "../state/preparation";
import { type Difference, letters } from "../state/regions";
import { count, length, listed, number, percent, plusMinus } from "../text/format";
import { type Phrase, reported } from "../text/phrase";
import { CHANCE, chanceTopic, said } from "./answer";
import { IN_A_SENTENCE } from "./evidence";
import { isContained } from "./reach";
import { DEFINITIONS } from "./words";

export function methods(report: Report): Phrase {
  return [
    ...models(report),
    ...preparation(report),
    ...reach(report),
    ...evidence(report),
    ...tolerance(report),
    ...sampling(report),
    ...convergence(report),
    ...outcome(report),
    ...differences(report),
    ` Reference: ${REFERENCE}`,
  ];
}

const REFERENCE =
  "M. Weiherer, F. Klein, B. Egger: Approximating Intersections and Differences Between Linear Statistical Shape Models Using Markov Chain Monte Carlo. WACV 2024, arXiv:2211.16314.";

function models(report: Report): Phrase {
  const one = (side: "a" | "b"): Phrase => {
    const { name, points, dimension, modes, format } = report.models[side];
    const path = `models.${side}`;
    return [
      `${side.toUpperCase()}, “${name}” (${format}; `,
      reported(`${path}.points`, points, count(points)),
      ` points in ${dimension} dimensions, `,
      reported(`${path}.modes`, modes, count(modes)),
      " modes)",
    ];
  };
  return [
    `Two linear statistical shape models were compared with Shapevenn ${report.engine} by the method of Weiherer et al. (2024): `,
    ...one("a"),
    ", and ",
    ...one("b"),
    ".",
    ...read(report),
  ];
}

/** What was said about reading the files: specimens left out or mirrored, order of coordinates. */
function read({ models }: Report): Phrase {
  return (["a", "b"] as const).flatMap((side) => {
    const applied = models[side].applied ?? [];
    if (applied.length === 0) return [];
    const sentences = applied.map(({ sentence }) => sentence).join(" ");
    return [` How ${side.toUpperCase()} was read: ${sentences}`];
  });
}

const ALIGNED = {
  none: "without alignment",
  rigid: "after B was aligned rigidly to A by its mean shape",
  similarity: "after B was aligned to A, scale included, by its mean shape",
};

function preparation(report: Report): Phrase {
  const { align, modes, prepare } = report.settings;
  const steps = preparationWords(completed(prepare));
  const kept: Phrase =
    modes === null
      ? []
      : [", the first ", reported("settings.modes", modes, count(modes)), " modes of each"];
  const also = steps.length === 0 ? "" : ` (preparation: ${steps.join("; ")})`;
  return [` They were compared ${ALIGNED[align]}`, ...kept, `${also}.`];
}

/** A sentence of the answer in terms of A and B, after a space. */
function answered(report: Report, ...topics: Topic[]): Phrase {
  const sentence = said(report, nounsOf("A", "B"), ...topics);
  return sentence ? [" ", ...sentence] : [];
}

/** How far the shapes of each model lie from the other, with the standard errors of the means. */
function reach(report: Report): Phrase {
  const found = report.reach;
  if (!found) return [];
  const { unit } = report.models.a;
  const means = (["a", "b"] as const)
    .filter((side) => !isContained(report, side))
    .flatMap((side, i): Phrase => {
      const [own, other] = letters(side);
      const lies = side === "a" ? found.aToB : found.bToA;
      return [i === 0 ? "" : " and ", ...meanOf(side, lies, unit), ` from ${own} to ${other}`];
    });
  return [
    ...answered(report, "reach-of-a"),
    ...answered(report, "reach-of-b"),
    ...(means.length === 0
      ? []
      : [" The mean distance over random shapes, with its standard error, is ", ...means, "."]),
  ];
}

function meanOf(
  side: Side,
  { mean, standardError }: { mean: number; standardError: number },
  unit: string,
): Phrase {
  const path = `reach.${side === "a" ? "aToB" : "bToA"}`;
  const text = plusMinus(mean, standardError);
  return [
    reported(`${path}.mean`, mean, text.mean),
    " ± ",
    reported(`${path}.standardError`, standardError, `${text.spread}\u202f${unit}`),
  ];
}

/** Whether that is more than chance, and how it was tested; nothing while it is being computed. */
function evidence(report: Report): Phrase {
  const topic = chanceTopic(report);
  if (topic === null) return [];
  if (topic === "chance-unknown" || !report.evidence) {
    return [" Whether these distances are more than chance is not known."];
  }
  const { shapes, modes, onePopulation } = report.evidence;
  const { permutations, exhaustive, statistics } = onePopulation;
  const number = (path: string, value: number) => reported(`evidence.${path}`, value, count(value));
  const many = number("onePopulation.permutations", permutations);
  return [
    " Whether this is more than chance was tested by relabelling: ",
    number("shapes.a", shapes.a),
    " training shapes of A and ",
    number("shapes.b", shapes.b),
    " of B were divided into two groups of these sizes ",
    ...(exhaustive ? ["in all ", many, " ways"] : ["at random, ", many, " times"]),
    `, and ${statistics.length} statistics of the first `,
    number("modes", modes),
    ` modes (${listed(statistics.map(({ name }) => IN_A_SENTENCE[name]))}) were compared, with Holm’s correction of their p.`,
    ...answered(report, ...CHANCE),
    ...answered(report, "told-apart-a"),
    ...answered(report, "told-apart-b"),
  ];
}

function tolerance(report: Report): Phrase {
  const { sigma, sigmaRecommended } = report.settings;
  const { unit } = report.models.a;
  const found = report.intersection.tolerance;
  const path = "intersection.tolerance";
  if (sigma === null) return [];
  const used = reported("settings.sigma", sigma, length(sigma, unit));
  if (!sigmaRecommended) {
    const other: Phrase = found
      ? [
          " (recommended would be ",
          reported(`${path}.recommended`, found.recommended, length(found.recommended, unit)),
          ")",
        ]
      : [];
    return [" The tolerance σ of the distance likelihood was chosen as ", used, ...other, "."];
  }
  return [" The tolerance σ of the distance likelihood was ", used, ...source(report), "."];
}

/** Where the recommended σ comes from. */
function source({ sigmaSource, intersection, models }: Report): Phrase {
  switch (sigmaSource) {
    case "left-out":
      return [", the mean distance of each training shape to the model of the others"];
    case "noise":
      return [", the distance of true members from their own model"];
    case "meeting":
      return [", the least distance of plausible shapes of the two models"];
    default: {
      const found = intersection.tolerance;
      if (!found) return [", recommended by the program"];
      const path = "intersection.tolerance";
      return [
        ", recommended by the program from the expected distance to the other model as σ → 0 and as σ → ∞, ",
        reported(`${path}.nearest`, found.nearest, number(found.nearest)),
        " and ",
        reported(`${path}.farthest`, found.farthest, length(found.farthest, models.a.unit)),
      ];
    }
  }
}

function sampling(report: Report): Phrase {
  const { chains, draws, burnIn, thin, seed, pooling, plausibility, weighted } = report.settings;
  const setting = (name: "chains" | "draws" | "burnIn" | "thin" | "weighted", value: number) =>
    reported(`settings.${name}`, value, count(value));
  const inference = report.intersection.inference;
  const both = pooling === "both" || pooling === undefined;
  const from = both ? "from both models in equal shares" : `from ${pooling.toUpperCase()} alone`;
  const moments: Phrase =
    inference && (inference.a.moments !== "draws" || inference.b.moments !== "draws")
      ? [
          "; its mean and covariance rest on a Gaussian fit and ",
          setting("weighted", weighted),
          " weighted draws with gradients per model",
        ]
      : [];
  return [
    ` The intersection A∩B was sampled ${from} by ${samplerNames(report, inference)}: `,
    setting("chains", chains),
    " chains and ",
    setting("draws", draws),
    " draws per model, burn-in ",
    setting("burnIn", burnIn),
    ", thinning ",
    setting("thin", thin),
    `, seed ${seed}`,
    plausibility === "idempotent" ? ", plausibilities combined by their geometric mean" : "",
    ...moments,
    ".",
  ];
}

const SAMPLED_BY: Record<Sampler, string> = {
  auto: "an automatically chosen sampler",
  variational: "independent draws from a Gaussian fit",
  independence: "an independence sampler that proposes from a Gaussian fit",
  hmc: "split Hamiltonian Monte Carlo",
  mala: "Langevin steps (MALA)",
  pcn: "preconditioned Crank–Nicolson steps",
  paper: "the random walk of the paper",
  "paper-corrected": "the random walk of the paper with its Hastings factor",
};

function samplerNames(
  report: Report,
  inference: Sides<InferenceReport> | null | undefined,
): string {
  const word = (side: "a" | "b") => {
    const name = inference?.[side].sampler ?? report.settings.sampler;
    return SAMPLED_BY[name] ?? name;
  };
  const [a, b] = [word("a"), word("b")];
  return a === b ? a : `${a} (from A) and ${b} (from B)`;
}

function convergence(report: Report): Phrase {
  const { rHatMax, essBulkMin, essTailMin, acceptance, paretoK, importanceEss, converged } =
    report.intersection.diagnostics;
  const path = "intersection.diagnostics";
  return [
    converged ? " The draws converged: " : " The draws did not converge: ",
    ...(rHatMax === null
      ? []
      : ["largest split R-hat ", reported(`${path}.rHatMax`, rHatMax, rHatMax.toFixed(4)), ", "]),
    "least effective sample size ",
    reported(`${path}.essBulkMin`, essBulkMin, count(essBulkMin)),
    " (bulk) and ",
    reported(`${path}.essTailMin`, essTailMin, count(essTailMin)),
    " (tails), acceptance ",
    reported(`${path}.acceptance`, acceptance, percent(acceptance)),
    ...(paretoK === null
      ? []
      : [", Pareto k ", reported(`${path}.paretoK`, paretoK, number(paretoK, 2))]),
    ...(importanceEss == null
      ? []
      : [
          ", effective size of the weights ",
          reported(`${path}.importanceEss`, importanceEss, count(importanceEss)),
        ]),
    ".",
  ];
}

function outcome(report: Report): Phrase {
  const { modes, meanDistance } = report.intersection;
  const { varianceOfAInB, varianceOfBInA } = report.overlap;
  const { unit } = report.models.a;
  const away = plusMinus(meanDistance.mean, meanDistance.sd);
  return [
    " The intersection model has ",
    reported("intersection.modes", modes, count(modes)),
    " modes; its shapes lie ",
    reported("intersection.meanDistance.mean", meanDistance.mean, away.mean),
    " ± ",
    reported("intersection.meanDistance.sd", meanDistance.sd, `${away.spread}\u202f${unit}`),
    " (mean vertex distance) from the nearest shape of the other model. B can make ",
    reported("overlap.varianceOfAInB", varianceOfAInB, percent(varianceOfAInB)),
    " of the variance of A, A ",
    reported("overlap.varianceOfBInA", varianceOfBInA, percent(varianceOfBInA)),
    " of that of B.",
  ];
}

function differences(report: Report): Phrase {
  const share = (key: Difference): Phrase => {
    const { probability, standardError } = report.differences[key];
    const path = `differences.${key}`;
    return [
      reported(`${path}.probability`, probability, percent(probability)),
      " (standard error ",
      reported(`${path}.standardError`, standardError, percent(standardError)),
      ")",
    ];
  };
  const { difference, differenceDraws } = report.settings;
  const { label, help } = DEFINITIONS[difference ?? "soft"];
  return [
    " The differences A∖B and B∖A were sampled by rejection, ",
    reported("settings.differenceDraws", differenceDraws, count(differenceDraws)),
    ` draws each, by the ${label} definition (${help.replace(/\.$/, "")}): `,
    ...share("aWithoutB"),
    " of the shapes of A and ",
    ...share("bWithoutA"),
    " of those of B are in them.",
  ];
}

/** BibTeX entries of the paper and of this program. */
export function bibTeX(engine: string): string {
  return `@inproceedings{weiherer2024approximating,
  author        = {Weiherer, Maximilian and Klein, Finn and Egger, Bernhard},
  title         = {Approximating Intersections and Differences Between Linear Statistical Shape Models Using {Markov} Chain {Monte} {Carlo}},
  booktitle     = {Proceedings of the IEEE/CVF Winter Conference on Applications of Computer Vision (WACV)},
  year          = {2024},
  eprint        = {2211.16314},
  archivePrefix = {arXiv}
}

@software{shapevenn,
  author  = {{The Shapevenn authors}},
  title   = {{Shapevenn}: intersections and differences of linear statistical shape models},
  version = {${engine}}
}
`;
}
