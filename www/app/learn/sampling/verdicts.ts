/** Judges numbers of the lessons in a sentence: convergence, a step, the error of a model, a difference. Pure. */
import type { ChainGroupSummary, LessonStep, Side } from "../../../worker/protocol";
import { letters } from "../../state/regions";
import { count, number, percent } from "../../text/format";

export interface Verdict {
  /** Whether the result is as it should be. */
  calm: boolean;
  text: string;
}

/** Limits of Vehtari et al. 2021: largest R-hat, and effective draws per chain. */
export const R_HAT_LIMIT = 1.01;
export const ESS_EACH = 100;

type Quality = Pick<ChainGroupSummary, "chains" | "draws" | "rHatMax" | "essBulkMin">;

/** Least number of draws per chain for diagnostics. */
const TOO_EARLY = 20;

/** Whether the chains have converged, by R-hat and effective draws. */
export function chainVerdict({ chains, draws, rHatMax, essBulkMin }: Quality): Verdict {
  if (rHatMax === null || essBulkMin === null || draws < TOO_EARLY * chains) {
    return { calm: false, text: "Too early to say: let it run." };
  }
  const [rHat, ess] = [number(rHatMax, 5), count(essBulkMin)];
  const wanted = ESS_EACH * chains;
  if (rHatMax < R_HAT_LIMIT && essBulkMin >= wanted) {
    return chains === 1
      ? {
          calm: false,
          text: `R-hat ${rHat} and ${ess} effective draws look well, but a single chain agrees with itself even if it has missed a part of the distribution: run several.`,
        }
      : {
          calm: true,
          text: `These ${chains} chains agree: R-hat ${rHat} is below ${R_HAT_LIMIT}, and they are worth ${ess} independent draws, at least ${wanted}.`,
        };
  }
  if (rHatMax >= R_HAT_LIMIT) {
    const whose = chains === 1 ? "the halves of this chain differ" : "the chains differ";
    return {
      calm: false,
      text: `Not converged yet: run longer. R-hat ${rHat} is not below ${R_HAT_LIMIT}: ${whose} by more than chance.`,
    };
  }
  return {
    calm: false,
    text: `Not converged yet: run longer. R-hat ${rHat} is fine, but the draws are worth only ${ess} independent ones; ${wanted} are wanted.`,
  };
}

/** Why a proposal was accepted or rejected. */
export function stepVerdict({ logRatio, uniform, accepted }: LessonStep): Verdict {
  const ratio = number(Math.exp(logRatio));
  if (logRatio >= 0) {
    return { calm: true, text: `r = ${ratio} is at least 1: always accepted.` };
  }
  return accepted
    ? { calm: true, text: `u = ${number(uniform)} is below r = ${ratio}: accepted.` }
    : {
        calm: false,
        text: `u = ${number(uniform)} is not below r = ${ratio}: rejected, the chain stays.`,
      };
}

/** R-hat from which on the chains clearly differ. */
const R_HAT_APART = 1.1;

/** Compares d_G to the known intersection with the error that sampling alone would cause. */
export function cloudVerdict(
  draws: number,
  found: number | null,
  closedForm: number | null,
  predicted: number | null,
  rHat: number | null,
): Verdict {
  if (rHat !== null && rHat >= R_HAT_APART) {
    return {
      calm: false,
      text: `These chains have not converged: R-hat is ${number(rHat)}, and the blue and orange draws differ. d_G may be small all the same: it compares the directions of the modes, not their standard deviations.`,
    };
  }
  if (found === null) return { calm: false, text: "The intersection of this pair is not known." };
  const said = `After ${count(draws)} draws of each model d_G is ${number(found)}`;
  if (closedForm !== null && found <= 2 * closedForm) {
    return {
      calm: true,
      text: `${said}: as near to the truth as the closed form (${number(closedForm)}). More draws would not help.`,
    };
  }
  if (predicted !== null && found > 4 * predicted) {
    return {
      calm: false,
      text: `${said}, far above the ${number(predicted)} expected for this number of effective draws: the chains have not reached all shapes yet, or σ is too large.`,
    };
  }
  return {
    calm: true,
    text: `${said}: sampling noise, which is inversely proportional to the square root of the number of effective draws. A tenth of it takes a hundred times as many.`,
  };
}

/** Judges the share of a model that the other cannot make, and PCA of the difference. */
export function differenceVerdict(side: Side, share: number, misled: number): Verdict {
  const [own, other] = letters(side);
  if (share > 0.95) {
    return {
      calm: false,
      text: `At this σ nearly everything of ${own} counts as different (${percent(share)}): hardly any shape lies within σ of ${other}. The difference is then simply ${own}.`,
    };
  }
  if (share < 0.05) {
    return {
      calm: false,
      text: `At this σ ${other} can make nearly everything of ${own}: only ${percent(share)} remains, far from the mean.`,
    };
  }
  return {
    calm: misled < 0.02,
    text: `${percent(misled)} of the shapes that PCA of these draws would make are shapes that ${other} makes too and that are not in the difference. A mean and a covariance cannot represent a hole in the density.`,
  };
}
