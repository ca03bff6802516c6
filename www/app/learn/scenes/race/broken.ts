/** What is broken in a race, and where its pictures look. Pure. */
import type { LaneFigures, LessonAsk, LessonLaw, LessonSampler } from "../../../../worker/lessons";
import { count, number, percent } from "../../../text/format";
import { R_HAT_LIMIT, type Verdict } from "../../sampling/verdicts";
import type { BREAKS, SceneValues } from "../../scenes";

export type Break = (typeof BREAKS)[number];

/** Those that race, in the order of what they gain. */
export const RACERS = ["paper", "paper-corrected", "mala", "hmc", "independence"] as const;
const WALKERS = ["paper", "paper-corrected"] as const;

/** Dimension on which the scaling move goes wrong for all to see. */
export const DIMENSION = 50;
/** By how much σ is too small, and by how many degrees B is turned. */
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

/** What a board shows: a square around the middle of the law, and the field around it. */
export interface View {
  centre: [number, number];
  extent: number;
  fieldExtent: number;
}

const REACH_SD = 3.4;

export function viewOf({ mean, covariance }: LessonLaw, target: string): View {
  if (target === "normal") return { centre: [0, 0], extent: REACH_SD, fieldExtent: REACH_SD };
  const q = mean.length;
  const [x = 0, y = 0] = mean;
  const [vx = 1, vy = 1] = [covariance[0], covariance[q + 1]];
  const extent = REACH_SD * Math.sqrt(Math.max(vx, vy, 1e-12));
  return { centre: [x, y], extent, fieldExtent: Math.max(Math.abs(x), Math.abs(y)) + extent };
}

export interface BreakWords {
  /** On its button. */
  name: string;
  /** What is done. */
  about: string;
}

export const BREAK_WORDS: Record<Break, BreakWords> = {
  none: { name: "Nothing broken", about: "All five draw from the same intersection." },
  scaling: {
    name: "Uncorrected scaling",
    about: `Both walks on a standard normal law of ${DIMENSION} coefficients, where ‖α‖²/q is 1 on average.`,
  },
  "one-chain": { name: "One chain", about: "Each sampler has a single chain." },
  sigma: { name: "σ far too small", about: "σ is a thirtieth of what it was." },
  misaligned: {
    name: "Misaligned models",
    about: `B is turned by ${TURNED}° before it is compared, as after a careless alignment.`,
  },
};

/** What went wrong, and how one notices. */
export function raceVerdict(
  what: Break,
  diagnostics: readonly LaneFigures[],
  sigma: number,
): Verdict {
  const [published, corrected] = diagnostics;
  const last = diagnostics.at(-1);
  if (!published || !corrected || !last) return { calm: true, text: "They are on their way." };
  switch (what) {
    case "scaling":
      return scalingVerdict(published, corrected);
    case "one-chain":
      return {
        calm: false,
        text: `With one chain R-hat can only compare its two halves (${rHat(corrected)} for the corrected walk). It does not know what the chain has never seen. One notices by starting several chains far apart.`,
      };
    case "sigma":
      return {
        calm: false,
        text: `The walk’s steps are far wider than the ridge: it accepts ${percent(corrected.acceptance)} of them and is worth ${draws(corrected)} effective draws in 1,000 evaluations. One notices by the acceptance, and by R-hat ${rHat(corrected)}.`,
      };
    case "misaligned":
      return {
        calm: false,
        text: `Good samplers converge all the same (R-hat ${rHat(last)}, independence): to shapes that B cannot make at all. No diagnostic of chains tells that. One notices by the draws’ distance to B, ${number(last.meanDistance ?? Number.NaN)}: ${count((last.meanDistance ?? 0) / sigma)} times σ.`,
      };
    case "none":
      return wholeVerdict(corrected, last);
  }
}

function scalingVerdict(published: LaneFigures, corrected: LaneFigures): Verdict {
  return {
    calm: false,
    text: `As published the walk shrinks: E‖α‖²/q is ${number(published.meanSquare)} instead of 1; with the Hastings factor it is ${number(corrected.meanSquare)}. R-hat does not tell right from wrong here (${rHat(corrected)} and ${rHat(published)}): chains can agree on the wrong law. One notices on a target whose answer is known, like this one.`,
  };
}

function wholeVerdict(walk: LaneFigures, best: LaneFigures): Verdict {
  const [slow, fast] = [walk.essPerThousand, best.essPerThousand];
  if (slow === null || fast === null) return { calm: true, text: "They are on their way." };
  const times = fast / slow;
  const doubt =
    walk.rHatMax !== null && walk.rHatMax >= R_HAT_LIMIT
      ? ` R-hat ${rHat(walk)} says that the walk has not converged.`
      : "";
  return times > 2
    ? {
        calm: true,
        text: `For the same work the independence sampler yields ${count(times)} times as many effective draws as the walk: it proposes from a Gaussian fit that is nearly the target itself.${doubt}`,
      }
    : {
        calm: false,
        text: `The independence sampler gains little here (${number(times)} times the walk): its fit is far from the target.${doubt}`,
      };
}

const rHat = ({ rHatMax }: LaneFigures) => (rHatMax === null ? "unknown" : number(rHatMax, 3));
const draws = ({ essPerThousand }: LaneFigures) =>
  essPerThousand === null ? "no" : number(essPerThousand, 2);
