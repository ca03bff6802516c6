/** Logarithmic axes for plots of errors and of efficiency. Pure. */

/** Position of a value between two others on a logarithmic axis, clamped to 0 … 1. */
export function logShare(value: number, low: number, high: number): number {
  if (!(value > low)) return 0;
  return Math.min(1, Math.log(value / low) / Math.log(high / low));
}

/** Ticks of a logarithmic axis: powers of ten, with twice and five times these if there are fewer than three. */
export function logTicks(low: number, high: number): number[] {
  const decades = multiples(low, high, [1]);
  return decades.length >= 3 ? decades : multiples(low, high, [1, 2, 5]);
}

function multiples(low: number, high: number, factors: readonly number[]): number[] {
  const found: number[] = [];
  for (let power = Math.floor(Math.log10(low)); 10 ** power <= high; power += 1) {
    for (const factor of factors) {
      const value = Number(`${factor}e${power}`);
      if (value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9)) found.push(value);
    }
  }
  return found;
}

/** Range of positive values with a margin, for a logarithmic axis. */
export function logRange(values: readonly (number | null | undefined)[]): [number, number] {
  const usable = values.filter((v): v is number => v != null && Number.isFinite(v) && v > 0);
  if (usable.length === 0) return [0.01, 1];
  const [low, high] = [Math.min(...usable) / 1.4, Math.max(...usable) * 1.4];
  return high / low < 4 ? [low / 2, high * 2] : [low, high];
}
