/**
 * Judges each diagnostic plot in one sentence: whether the chains agree, and what to change if they do not. Pure.
 *
 * R-hat must be below 1.01 and the effective sample size at least 400, 100 for each of four chains: Vehtari,
 * Gelman, Simpson, Carpenter & Bürkner, “Rank-normalization, folding, and localization: an improved R-hat”,
 * Bayesian Analysis 16 (2021). The mean of 400 independent draws has a standard error of 0.05 standard
 * deviations; a deviation of more than two standard errors is reported. The other limits are our own choice.
 */
import type { ChainPlots, PairPlots, Sampler, SweepPoint } from "../../worker/protocol";
import { capital, count, length, number, percent, plusMinus } from "../text/format";
import type { Advice } from "../ui/Chart";
import { average, halvesOf, oddest, splitRHat, spreadOf } from "./chains";
import {
  chainsOf,
  deviation,
  drawsOf,
  gaussianShare,
  insignificantLag,
  pairsOf,
  rankBand,
  shareWithin,
} from "./diagnosing";
import { ESS, R_HAT } from "./words";

/** Two standard errors of the mean of 400 independent draws, in standard deviations. */
const OFF = 2 / Math.sqrt(ESS);

const calm = (text: string): Advice => ({
  calm: true,
  text: `${text}: nothing to do.`,
  chain: null,
});

function remedy(sampler: Sampler): string {
  return sampler === "auto" ? "draw longer" : "draw longer or use the automatic sampler";
}

/** Advice on the trace plot; `rHat` is the engine's value for all draws, null where it is infinite. */
export function traceAdvice(
  diagnostics: ChainPlots,
  rHat: number | null,
  sampler: Sampler,
): Advice {
  const chains = chainsOf(diagnostics.draws, diagnostics.chains);
  if ((rHat ?? splitRHat(chains)) < R_HAT) return calm(`The ${chains.length} chains overlap`);
  const { kind, chain, size, ratio } = oddest(chains);
  const name = `Chain ${chain + 1}`;
  const what = {
    apart: `The mean of chain ${chain + 1} is ${number(size, 2)} SD from that of the others`,
    wanders: `${name} drifts: the means of its halves differ by ${number(size, 2)} SD`,
    spread: `${name} has ${number(ratio, 2)} times the SD of the others`,
  }[kind];
  const then = kind === "wanders" ? `. ${capital(remedy(sampler))}.` : `: ${remedy(sampler)}.`;
  return { calm: false, text: what + then, chain };
}

/** Share of bars outside the band from which on it is mentioned; by chance it is a twentieth. */
const MANY_OUTSIDE = 0.1;

/** Advice on the rank plots: R-hat tells whether the chains differ, the bars which chain and at which ranks. */
export function rankAdvice(diagnostics: ChainPlots, rHat: number | null, sampler: Sampler): Advice {
  const { bins, ranks } = diagnostics;
  const { expected, low, high } = rankBand(diagnostics);
  const bars = chainsOf(ranks, diagnostics.chains);
  const outside = ranks.reduce((sum, bar) => sum + (bar < low || bar > high ? 1 : 0), 0);
  const known = rHat ?? splitRHat(chainsOf(diagnostics.draws, diagnostics.chains));
  if (known < R_HAT) {
    return outside > MANY_OUTSIDE * ranks.length
      ? calm(
          "Some bars lie outside the band because successive draws are correlated, not because chains differ",
        )
      : calm("Every chain has its share of low, middle and high ranks");
  }
  const uneven = bars.map((row) => row.reduce((sum, bar) => sum + Math.abs(bar - expected), 0));
  const chain = uneven.indexOf(Math.max(...uneven));
  const row = bars[chain] ?? [];
  const part = (from: number, to: number) =>
    average(row.slice(Math.floor(from * bins), Math.ceil(to * bins))) / expected;
  const parts: [string, number][] = [
    ["low", part(0, 1 / 3)],
    ["middle", part(1 / 3, 2 / 3)],
    ["high", part(2 / 3, 1)],
  ];
  const [where, times] = parts.reduce((one, other) => (other[1] > one[1] ? other : one));
  return {
    calm: false,
    text: `Chain ${chain + 1} has ${number(times, 2)} times its share of the ${where} ranks: ${remedy(sampler)}.`,
    chain,
  };
}

/** Advice on the autocorrelation plot: whether the draws amount to enough independent ones. */
export function autocorrelationAdvice(
  diagnostics: ChainPlots,
  essBulk: number,
  sampler: Sampler,
): Advice {
  const draws = drawsOf(diagnostics);
  const lag = insignificantLag(diagnostics.autocorrelation, draws);
  const last = diagnostics.autocorrelation.length - 1;
  if (essBulk >= ESS) {
    const far =
      lag === null
        ? `Draws are correlated over more than ${last} steps`
        : lag <= 1
          ? "Successive draws are uncorrelated"
          : `Draws ${lag} steps apart are uncorrelated`;
    return calm(
      `${far}, and the ${count(draws)} draws are worth ${count(essBulk)} independent ones`,
    );
  }
  const few = `the ${count(draws)} draws are worth only ${count(essBulk)} independent ones, and ${ESS} are needed`;
  const far =
    lag === null
      ? `Draws are correlated over more than ${last} steps`
      : `Draws are correlated over up to ${lag} steps`;
  return { calm: false, text: `${far}; ${few}: ${remedy(sampler)}.`, chain: null };
}

/**
 * Advice on the plot of the distance d over the draws. The report has no R-hat of d, so the split R-hat of the
 * shown draws is taken.
 */
export function distanceAdvice(diagnostics: ChainPlots, unit: string, sampler: Sampler): Advice {
  const chains = chainsOf(diagnostics.distances, diagnostics.chains);
  const { mean, variance } = spreadOf(chains.flat());
  const half = Math.floor((chains[0]?.length ?? 0) / 2);
  // Halves of n independent draws have an R-hat of about 1 ± 0.3/n by chance.
  if (splitRHat(chains) < Math.max(R_HAT, 1 + 1 / half)) {
    const level = plusMinus(mean, Math.sqrt(variance));
    return calm(
      `d has the same level in every chain, ${level.mean}\u00a0±\u00a0${level.spread}\u202f${unit}`,
    );
  }
  const halves = chains.map((chain) => halvesOf(chain).map((part) => spreadOf(part).mean));
  const early = average(halves.map(([first]) => first ?? 0));
  const late = average(halves.map(([, second]) => second ?? 0));
  const means = chains.map((chain) => spreadOf(chain).mean);
  const away = means.map((value) => Math.abs(value - mean));
  const chain = away.indexOf(Math.max(...away));
  if (Math.abs(late - early) > (away[chain] ?? 0)) {
    const way = late < early ? "falls" : "rises";
    return {
      calm: false,
      text: `d still ${way}, from ${number(early)} to ${length(late, unit)} on average: raise the burn-in, so that draws are kept only after the chains have converged.`,
      chain: null,
    };
  }
  return {
    calm: false,
    text: `Chain ${chain + 1} has a mean distance of ${number(means[chain] ?? Number.NaN)}, all chains together ${length(mean, unit)}: ${remedy(sampler)}.`,
    chain,
  };
}

/** Standard errors by which the share of draws within an ellipse may be off, for up to ten ellipses. */
const SHARE_ERRORS = 4;

/** Advice on the pair plots: whether the draws are Gaussian, and whether the Gaussian fit has their moments. */
export function pairsAdvice(diagnostics: PairPlots, essBulk: number): Advice {
  const { modes, fit, count: drawn } = diagnostics;
  const not = (text: string): Advice => ({ calm: false, text, chain: null });
  if (essBulk < ESS) {
    return not(
      `${count(essBulk)} effective draws are too few to compare with a Gaussian; draw longer first.`,
    );
  }
  const wanted = gaussianShare(2);
  const shares = pairsOf(modes.length).map(([i, j]) => ({
    i,
    j,
    share: shareWithin(diagnostics, i, j, 2),
  }));
  const off = fit === null ? null : farthest(diagnostics, fit);
  if (off !== null && off.size > OFF) return not(off.text);
  const error = Math.sqrt((wanted * (1 - wanted)) / Math.min(drawn, essBulk));
  const odd = shares.reduce<(typeof shares)[number] | null>(
    (one, other) =>
      one && Math.abs(one.share - wanted) >= Math.abs(other.share - wanted) ? one : other,
    null,
  );
  if (odd && Math.abs(odd.share - wanted) > SHARE_ERRORS * error) {
    return not(
      `Modes ${odd.i + 1} and ${odd.j + 1} are not Gaussian: ${percent(odd.share)} of the draws lie within 2 SD, where a Gaussian has ${percent(wanted)}. Look at samples, not at mean and SD alone.`,
    );
  }
  const filled = odd
    ? `The draws are distributed as a Gaussian, ${percent(average(shares.map(({ share }) => share)))} of them within 2 SD`
    : "There is no pair of modes to compare with a Gaussian";
  return calm(off === null ? filled : `${filled}, and the Gaussian fit has their moments`);
}

/** The mode in which the Gaussian fit differs most from the draws, by mean or by standard deviation. */
function farthest(diagnostics: PairPlots, fit: NonNullable<PairPlots["fit"]>) {
  const each = diagnostics.modes.map((_, i) => {
    const [own, theirs] = [deviation(diagnostics, i), deviation(fit, i)];
    const shift = Math.abs((diagnostics.mean[i] ?? 0) - (fit.mean[i] ?? 0)) / theirs;
    const ratio = own / theirs;
    const then = "Use the moments of the draws, not the Gaussian fit.";
    return shift > Math.abs(ratio - 1)
      ? {
          size: shift,
          text: `The mean of the fit is ${number(shift, 2)} SD from that of the draws in mode ${i + 1}. ${then}`,
        }
      : {
          size: Math.abs(ratio - 1),
          text: `The draws have ${number(ratio, 2)} times the SD of the fit in mode ${i + 1}. ${then}`,
        };
  });
  return each.reduce((one, other) => (other.size > one.size ? other : one));
}

/** A relative change of the SD of A∩B by less than this is called small. */
const LITTLE = 0.1;

/** Advice on the σ sweep: how much the SD of A∩B changes if the σ in use is doubled. */
export function sweepAdvice(points: readonly SweepPoint[], sigma: number): Advice | null {
  const after = Math.max(
    1,
    points.findIndex((point) => point.sigma >= sigma),
  );
  const inside = points.some((point) => point.sigma >= sigma);
  const [one, other] = inside ? [points[after - 1], points[after]] : points.slice(-2);
  if (!one || !other) return null;
  const slope = Math.log(other.vertexSd / one.vertexSd) / Math.log(other.sigma / one.sigma);
  const change = 2 ** slope - 1;
  if (Math.abs(change) < LITTLE) {
    return calm(`Doubling σ would change the SD of A∩B by only ${percent(Math.abs(change))}`);
  }
  const way = change > 0 ? "raise" : "lower";
  return {
    calm: false,
    text: `Doubling σ would ${way} the SD of A∩B by ${percent(Math.abs(change))}: state σ with every number.`,
    chain: null,
  };
}
