/** The four failures of the scene: their settings, names and explanations, and the drawn range. Pure. */
import type {
  ChainGroupSummary,
  LessonAsk,
  LessonSampler,
  Moments,
} from "../../../../worker/protocol";
import { count, number, percent } from "../../../text/format";
import { R_HAT_LIMIT, type Verdict } from "../../sampling/verdicts";
import type { BREAKS, SceneValues } from "../../scenes";

export type Break = (typeof BREAKS)[number];

/** The compared samplers, in the order of their efficiency. */
export const RACERS = ["paper", "paper-corrected", "mala", "hmc", "independence"] as const;
const WALKERS = ["paper", "paper-corrected"] as const;

/** Dimension in which the error of the scaling move is clearly visible. */
export const DIMENSION = 50;
/** Factor by which σ is too small, and degrees by which B is rotated. */
const SIGMA_OVER = 30;
const TURNED = 8;

interface Broken {
  opening: Omit<Extract<LessonAsk, { ask: "open" }>, "ask">;
  samplers: readonly LessonSampler[];
  target: "intersection" | "normal";
  dimension: number | null;
  oneChain: boolean;
}

export function broken(values: SceneValues<"race">): Broken {
  const { pair, sigma } = values;
  const scaling = values.break === "scaling";
  return {
    opening: {
      pair,
      sigma: values.break === "sigma" ? sigma / SIGMA_OVER : sigma,
      ...(values.break === "misaligned" ? { turned: TURNED } : {}),
    },
    samplers: scaling ? WALKERS : RACERS,
    target: scaling ? "normal" : "intersection",
    dimension: scaling ? DIMENSION : null,
    oneChain: values.break === "one-chain",
  };
}

/** Range of a picture: a square around the mean of the distribution, and that of the density. */
export interface View {
  centre: [number, number];
  extent: number;
  fieldExtent: number;
}

const REACH_SD = 3.4;

export function viewOf({ mean, covariance }: Moments, target: string): View {
  if (target === "normal") return { centre: [0, 0], extent: REACH_SD, fieldExtent: REACH_SD };
  const q = mean.length;
  const [x = 0, y = 0] = mean;
  const [vx = 1, vy = 1] = [covariance[0], covariance[q + 1]];
  const extent = REACH_SD * Math.sqrt(Math.max(vx, vy, 1e-12));
  return { centre: [x, y], extent, fieldExtent: Math.max(Math.abs(x), Math.abs(y)) + extent };
}

export interface BreakWords {
  /** Label of its button. */
  name: string;
  /** Explanation. */
  about: string;
}

export const BREAK_WORDS: Record<Break, BreakWords> = {
  none: { name: "Nothing broken", about: "All five samplers draw from the same intersection." },
  scaling: {
    name: "Uncorrected scaling",
    about: `Both random walks on a standard normal distribution of ${DIMENSION} coefficients, where ‖α‖²/q is 1 on average.`,
  },
  "one-chain": { name: "One chain", about: "Each sampler has a single chain." },
  sigma: { name: "σ far too small", about: "σ is a thirtieth of what it was." },
  misaligned: {
    name: "Misaligned models",
    about: `B is rotated by ${TURNED}° before it is compared, as after a wrong alignment.`,
  },
};

/** Explains a failure with its numbers, and how it can be detected. */
export function raceVerdict(
  what: Break,
  diagnostics: readonly ChainGroupSummary[],
  sigma: number,
): Verdict {
  const [published, corrected] = diagnostics;
  const last = diagnostics.at(-1);
  if (!published || !corrected || !last)
    return { calm: true, text: "Waiting for the first diagnostics." };
  switch (what) {
    case "scaling":
      return scalingVerdict(published, corrected);
    case "one-chain":
      return {
        calm: false,
        text: `With one chain R-hat can only compare its two halves (${rHat(corrected)} for the corrected walk). It does not show which shapes the chain has not reached. Several chains with distant starting points would.`,
      };
    case "sigma":
      return {
        calm: false,
        text: `The steps of the random walk are far wider than the ridge of the density: it accepts ${percent(corrected.acceptance)} of them and has ${draws(corrected)} effective draws in 1,000 evaluations. The acceptance shows it, and R-hat ${rHat(corrected)}.`,
      };
    case "misaligned":
      return {
        calm: false,
        text: `Good samplers converge nevertheless (R-hat ${rHat(last)}, independence), to shapes that B cannot make. No diagnostic of chains detects this. The distance of the draws to B does, ${number(last.meanDistance ?? Number.NaN)}: ${count((last.meanDistance ?? 0) / sigma)} times σ.`,
      };
    case "none":
      return wholeVerdict(corrected, last);
  }
}

function scalingVerdict(published: ChainGroupSummary, corrected: ChainGroupSummary): Verdict {
  return {
    calm: false,
    text: `As published the random walk has too little variance: E‖α‖²/q is ${number(published.meanSquare)} instead of 1; with the Hastings factor it is ${number(corrected.meanSquare)}. R-hat does not detect this (${rHat(corrected)} and ${rHat(published)}): chains can agree on the wrong distribution. A test on a known distribution, like this one, does.`,
  };
}

function wholeVerdict(walk: ChainGroupSummary, best: ChainGroupSummary): Verdict {
  const [slow, fast] = [walk.essPerThousand, best.essPerThousand];
  if (slow === null || fast === null)
    return { calm: true, text: "Waiting for the first diagnostics." };
  const times = fast / slow;
  const doubt =
    walk.rHatMax !== null && walk.rHatMax >= R_HAT_LIMIT
      ? ` R-hat ${rHat(walk)} says that the walk has not converged.`
      : "";
  return times > 2
    ? {
        calm: true,
        text: `For the same number of evaluations the independence sampler has ${count(times)} times as many effective draws as the random walk: it proposes from a Gaussian fit that is nearly the target itself.${doubt}`,
      }
    : {
        calm: false,
        text: `The independence sampler has little advantage here (${number(times)} times the random walk): its fit is far from the target.${doubt}`,
      };
}

const rHat = ({ rHatMax }: ChainGroupSummary) =>
  rHatMax === null ? "unknown" : number(rHatMax, 3);
const draws = ({ essPerThousand }: ChainGroupSummary) =>
  essPerThousand === null ? "no" : number(essPerThousand, 2);
