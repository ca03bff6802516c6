/**
 * What to do about draws, in one sentence under each plot, from its own numbers. Pure.
 *
 * Chains agree below an R-hat of 1.01, and diagnostics can be quoted from 400 effective draws on, 100 for each
 * of four chains: Vehtari, Gelman, Simpson, Carpenter & Bürkner, “Rank-normalization, folding, and
 * localization: an improved R-hat”, Bayesian Analysis 16 (2021). So many draws know a mean to 0.05
 * standard deviations; twice that is what is said to be off here. The other limits are ours and say so.
 */
import type { ChainFigures, PairFigures, SamplerName, SweepPoint } from "../../worker/protocol";
import { count, length, number, percent, plusMinus } from "../text/format";
import type { Advice } from "../ui/Chart";
import { average, halvesOf, oddest, splitRHat, spreadOf } from "./chains";
import {
  chainsOf,
  deviation,
  drawsOf,
  gaussianShare,
  pairsOf,
  rankBand,
  shareWithin,
  silentLag,
} from "./diagnosing";
import { ESS, R_HAT } from "./words";

/** Two standard errors of a mean that 400 draws know, in standard deviations. */
const OFF = 2 / Math.sqrt(ESS);

const calm = (text: string): Advice => ({
  calm: true,
  text: `${text}: nothing to do.`,
  chain: null,
});

function remedy(sampler: SamplerName): string {
  return sampler === "auto" ? "draw longer" : "draw longer or use the automatic sampler";
}

const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** Of the traces; `rHat` as the engine has it of all draws, null where it is infinite. */
export function traceAdvice(
  diagnostics: ChainFigures,
  rHat: number | null,
  sampler: SamplerName,
): Advice {
  const chains = chainsOf(diagnostics.draws, diagnostics.chains);
  if ((rHat ?? splitRHat(chains)) < R_HAT) return calm(`The ${chains.length} chains overlap`);
  const { kind, chain, size, ratio } = oddest(chains);
  const name = `Chain ${chain + 1}`;
  const what = {
    apart: `${name} sits apart, ${number(size, 2)} SD from the others`,
    wanders: `${name} wanders: its halves differ by ${number(size, 2)} SD`,
    spread: `${name} spreads ${number(ratio, 2)} times as far as the others`,
  }[kind];
  const then = kind === "wanders" ? `. ${capital(remedy(sampler))}.` : `: ${remedy(sampler)}.`;
  return { calm: false, text: what + then, chain };
}

/** A twentieth of the bars leaves the band by chance; of more than so many something is said. */
const MANY_OUTSIDE = 0.1;

/** Of the rank plots: R-hat says whether the chains differ, the bars which one and where. */
export function rankAdvice(
  diagnostics: ChainFigures,
  rHat: number | null,
  sampler: SamplerName,
): Advice {
  const { bins, ranks } = diagnostics;
  const { expected, low, high } = rankBand(diagnostics);
  const bars = chainsOf(ranks, diagnostics.chains);
  const outside = ranks.reduce((sum, bar) => sum + (bar < low || bar > high ? 1 : 0), 0);
  const known = rHat ?? splitRHat(chainsOf(diagnostics.draws, diagnostics.chains));
  if (known < R_HAT) {
    return outside > MANY_OUTSIDE * ranks.length
      ? calm("Some bars leave the band because draws in a row are alike, not because chains differ")
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

export function autocorrelationAdvice(
  diagnostics: ChainFigures,
  essBulk: number,
  sampler: SamplerName,
): Advice {
  const draws = drawsOf(diagnostics);
  const lag = silentLag(diagnostics.autocorrelation, draws);
  const last = diagnostics.autocorrelation.length - 1;
  if (essBulk >= ESS) {
    const far =
      lag === null
        ? `Draws are alike for more than ${last} steps`
        : lag <= 1
          ? "Successive draws are unrelated"
          : `Draws ${lag} steps apart are unrelated`;
    return calm(`${far}, and ${count(essBulk)} of ${count(draws)} count`);
  }
  const few = `only ${count(essBulk)} of ${count(draws)} draws count, and ${ESS} are needed`;
  const far =
    lag === null
      ? `Draws stay alike for more than ${last} steps`
      : `Draws are alike up to ${lag} steps`;
  return { calm: false, text: `${far}; ${few}: ${remedy(sampler)}.`, chain: null };
}

/** Of d over the draws: it has no R-hat in the report, so the plain one of what is shown is taken. */
export function distanceAdvice(
  diagnostics: ChainFigures,
  unit: string,
  sampler: SamplerName,
): Advice {
  const chains = chainsOf(diagnostics.distances, diagnostics.chains);
  const { mean, variance } = spreadOf(chains.flat());
  const half = Math.floor((chains[0]?.length ?? 0) / 2);
  // Halves of n independent draws have an R-hat of about 1 ± 0.3/n by chance.
  if (splitRHat(chains) < Math.max(R_HAT, 1 + 1 / half)) {
    const level = plusMinus(mean, Math.sqrt(variance));
    return calm(
      `d keeps its level in every chain, ${level.mean}\u00a0±\u00a0${level.spread}\u202f${unit}`,
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
      text: `d still ${way}, from ${number(early)} to ${length(late, unit)} on average: raise the burn-in, so that draws are kept only once the chains have arrived.`,
      chain: null,
    };
  }
  return {
    calm: false,
    text: `Chain ${chain + 1} keeps a distance of its own, ${number(means[chain] ?? Number.NaN)} against ${length(mean, unit)} on average: ${remedy(sampler)}.`,
    chain,
  };
}

/** Standard errors by which the share within an ellipse may be off, with up to ten looked at. */
const SHARE_ERRORS = 4;

/** Of the pairs: whether the draws are like the Gaussian that stands for them, and like the fit. */
export function pairsAdvice(diagnostics: PairFigures, essBulk: number): Advice {
  const { modes, fit, count: drawn } = diagnostics;
  const not = (text: string): Advice => ({ calm: false, text, chain: null });
  if (essBulk < ESS) {
    return not(
      `${count(essBulk)} effective draws are too few to tell a Gaussian by; draw longer first.`,
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
      `Modes ${odd.i + 1} and ${odd.j + 1} are not like a Gaussian: ${percent(odd.share)} of the draws lie within 2 SD where it has ${percent(wanted)}. Look at samples, not at mean and SD alone.`,
    );
  }
  const filled = odd
    ? `The draws fill their ellipses as a Gaussian does, ${percent(average(shares.map(({ share }) => share)))} within 2 SD`
    : "The draws have the spread that they should";
  return calm(off === null ? filled : `${filled}, and the fit lies on the moments`);
}

/** Where the fit is farthest from the moments, in its own standard deviations. */
function farthest(diagnostics: PairFigures, fit: NonNullable<PairFigures["fit"]>) {
  const each = diagnostics.modes.map((_, i) => {
    const [own, theirs] = [deviation(diagnostics, i), deviation(fit, i)];
    const shift = Math.abs((diagnostics.mean[i] ?? 0) - (fit.mean[i] ?? 0)) / theirs;
    const ratio = own / theirs;
    const then = "Trust the moments of the draws, not the first guess.";
    return shift > Math.abs(ratio - 1)
      ? {
          size: shift,
          text: `The fit lies ${number(shift, 2)} SD beside the draws in mode ${i + 1}. ${then}`,
        }
      : {
          size: Math.abs(ratio - 1),
          text: `The draws vary ${number(ratio, 2)} times as much as the fit in mode ${i + 1}. ${then}`,
        };
  });
  return each.reduce((one, other) => (other.size > one.size ? other : one));
}

/** A change of the intersection by less is not spoken of. */
const LITTLE = 0.1;

/** Of the σ sweep: how much hangs on the σ in use. */
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
    return calm(`Twice the σ would change how far A∩B varies by only ${percent(Math.abs(change))}`);
  }
  const way = change > 0 ? "more" : "less";
  return {
    calm: false,
    text: `Twice the σ would let A∩B vary ${percent(Math.abs(change))} ${way}: say which σ you used with every number.`,
    chain: null,
  };
}
