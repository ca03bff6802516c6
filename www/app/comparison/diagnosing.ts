/**
 * Computes what the diagnostic plots draw: bands of rank plots, covariance ellipses, the coefficient with the
 * worst diagnostics. Pure.
 *
 * Rank plots: Vehtari, Gelman, Simpson, Carpenter & Bürkner, “Rank-normalization, folding, and
 * localization”, Bayesian Analysis 16 (2021).
 */
import type { ChainPlots, ModeDiagnostics, PairPlots, Report, Sides } from "../../worker/protocol";
import { R_HAT, worstMode } from "./words";

export interface Coefficient {
  side: "a" | "b";
  /** From 0. */
  mode: number;
}

/** Largest number of lines that can be distinguished in one plot. */
const MOST_CHAINS = 32;

/** The draws of each chain. */
export function chainsOf(values: ArrayLike<number>, chains: number): number[][] {
  const length = Math.floor(values.length / chains);
  return Array.from({ length: chains }, (_, chain) =>
    Array.from({ length }, (_, i) => values[chain * length + i] ?? Number.NaN),
  );
}

/** Which chains are drawn, from 0: all of a few; of many, the first ones and the one that the advice names. */
export function shownChains(chains: number, named: number | null): number[] {
  const first = Array.from({ length: Math.min(chains, MOST_CHAINS) }, (_, chain) => chain);
  return named === null || first.includes(named) ? first : [...first.slice(0, -1), named];
}

/**
 * The coefficient with the worst diagnostics, of one model or of both: the largest R-hat, or, if all are below the
 * limit, the fewest effective draws.
 */
export function worstCoefficient(report: Report, side: "a" | "b" | null): Coefficient {
  const both = report.intersection.coefficients;
  const fallback: Coefficient = { side: side ?? "a", mode: 0 };
  if (!both) return fallback;
  const nothing: ModeDiagnostics = {
    rHat: [],
    essBulk: [],
    essTail: [],
    mcseMean: [],
    mcseSd: [],
    autocorrelation: [],
  };
  const looked: Sides<ModeDiagnostics> = {
    a: side === "b" ? nothing : both.a,
    b: side === "a" ? nothing : both.b,
  };
  // An infinite R-hat, of chains that never move, is null in JSON.
  for (const name of ["a", "b"] as const) {
    const stuck = looked[name].rHat.findIndex((value) => !Number.isFinite(value));
    if (stuck >= 0) return { side: name, mode: stuck };
  }
  const unlike = worstMode(looked, "rHat");
  const found = unlike && unlike.value >= R_HAT ? unlike : (worstMode(looked, "essBulk") ?? unlike);
  return found ? { side: found.side, mode: found.mode - 1 } : fallback;
}

export interface RankBand {
  /** Expected draws in each bar if the chains agree. */
  expected: number;
  low: number;
  high: number;
}

/** Half width of a band in standard deviations. */
const BAND = 2;

/**
 * Band of the bars of a rank plot by chance: of N ranks in bins, each goes to one of the chains, so a bar is
 * hypergeometric with variance e (1 − 1/chains)(1 − 1/bins), e its mean.
 */
export function rankBand({ ranks, chains, bins }: ChainPlots): RankBand {
  const total = ranks.reduce((sum, value) => sum + value, 0);
  const expected = total / (chains * bins);
  const reach = BAND * Math.sqrt(expected * (1 - 1 / chains) * (1 - 1 / bins));
  return { expected, low: Math.max(0, expected - reach), high: expected + reach };
}

/** Total number of draws from which the diagnostics are computed. */
export function drawsOf({ ranks }: ChainPlots): number {
  return ranks.reduce((sum, value) => sum + value, 0);
}

/** Autocorrelations below this are not significant. */
export function noiseBand(draws: number): number {
  return BAND / Math.sqrt(draws);
}

/** The first lag whose autocorrelation is not significant; null if there is none. */
export function insignificantLag(autocorrelation: ArrayLike<number>, draws: number): number | null {
  const band = noiseBand(draws);
  const lag = Array.from(autocorrelation).findIndex((value) => Math.abs(value) < band);
  return lag < 0 ? null : lag;
}

export interface Gaussian {
  mean: readonly number[];
  /** Square, row by row. */
  covariance: readonly number[];
}

export interface Ellipse {
  x: number;
  y: number;
  /** Semi-axes of one standard deviation, the longer one first. */
  long: number;
  short: number;
  /** Angle of the longer semi-axis to the x axis, in radians, anticlockwise. */
  angle: number;
}

/** Ellipse of one standard deviation of two coordinates of a Gaussian. */
export function ellipseOf({ mean, covariance }: Gaussian, i: number, j: number): Ellipse {
  const size = mean.length;
  const at = (row: number, column: number) => covariance[row * size + column] ?? 0;
  const [xx, xy, yy] = [at(i, i), at(i, j), at(j, j)];
  const [middle, half] = [(xx + yy) / 2, Math.hypot((xx - yy) / 2, xy)];
  return {
    x: mean[i] ?? 0,
    y: mean[j] ?? 0,
    long: Math.sqrt(Math.max(0, middle + half)),
    short: Math.sqrt(Math.max(0, middle - half)),
    angle: Math.atan2(2 * xy, xx - yy) / 2,
  };
}

/** Share of the draws within a number of standard deviations in two of their coefficients. */
export function shareWithin(
  diagnostics: PairPlots,
  i: number,
  j: number,
  deviations: number,
): number {
  const { mean, covariance, draws, count } = diagnostics;
  const size = diagnostics.modes.length;
  const at = (row: number, column: number) => covariance[row * size + column] ?? 0;
  const [xx, xy, yy] = [at(i, i), at(i, j), at(j, j)];
  const determinant = xx * yy - xy * xy;
  let within = 0;
  for (let draw = 0; draw < count; draw += 1) {
    const x = (draws[draw * size + i] ?? 0) - (mean[i] ?? 0);
    const y = (draws[draw * size + j] ?? 0) - (mean[j] ?? 0);
    const squared = (yy * x * x - 2 * xy * x * y + xx * y * y) / determinant;
    if (squared <= deviations * deviations) within += 1;
  }
  return within / count;
}

/** The same share of a Gaussian, in two dimensions. */
export function gaussianShare(deviations: number): number {
  return 1 - Math.exp(-0.5 * deviations * deviations);
}

export function deviation({ mean, covariance }: Gaussian, i: number): number {
  return Math.sqrt(Math.max(0, covariance[i * mean.length + i] ?? 0));
}

export function correlation(gaussian: Gaussian, i: number, j: number): number {
  const shared = gaussian.covariance[i * gaussian.mean.length + j] ?? 0;
  return shared / (deviation(gaussian, i) * deviation(gaussian, j));
}

/** Every pair of the first modes, the lower triangle row by row. */
export function pairsOf(modes: number): [number, number][] {
  return Array.from({ length: modes }, (_, j) => j).flatMap((j) =>
    Array.from({ length: j }, (_, i): [number, number] => [i, j]),
  );
}
