/** Scales and ticks of plots. Pure. */
import { number } from "./format";

export type Scale = (value: number) => number;

export function linear(from: number, to: number, start: number, end: number): Scale {
  const span = to - from || 1;
  return (value) => start + ((value - from) / span) * (end - start);
}

export function logarithmic(from: number, to: number, start: number, end: number): Scale {
  const scale = linear(Math.log(from), Math.log(to), start, end);
  return (value) => scale(Math.log(value));
}

/** Round values from `low` to about `high`, some `count` of them. */
export function ticks(low: number, high: number, count: number): number[] {
  const span = high - low;
  if (!(span > 0) || !Number.isFinite(span)) return [low];
  const rough = span / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5, 10].find((factor) => factor * power >= rough) ?? 10);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.ceil(high / step - 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
}

/** The powers of ten from `low` to `high`. */
export function decades(low: number, high: number): number[] {
  const first = Math.ceil(Math.log10(low) - 1e-9);
  const last = Math.floor(Math.log10(high) + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => 10 ** (first + i));
}

/** Label of a tick, without trailing zeros. */
export function tickText(value: number): string {
  const size = Math.abs(value);
  if (size < 1e-12) return "0";
  if (size < 1e-3 || size >= 1e4) return number(value, 2);
  return String(Number(value.toPrecision(4))).replace("-", "−");
}

const SWEEP_POINTS = 17;

/** The values of the σ sweep, from a hundredth to a hundred times the recommended σ, which is one of them. */
export function sweepSigmas(middle: number): number[] {
  const half = (SWEEP_POINTS - 1) / 2;
  return Array.from({ length: SWEEP_POINTS }, (_, i) => middle * 10 ** ((2 * (i - half)) / half));
}
