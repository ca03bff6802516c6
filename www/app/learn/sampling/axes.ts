/** Axes over the logarithm, for plots of errors and of efficiency. Pure. */

/** Where a value lies between two others on a logarithmic axis, 0 … 1; outside of them at an end. */
export function logShare(value: number, low: number, high: number): number {
  if (!(value > low)) return 0;
  return Math.min(1, Math.log(value / low) / Math.log(high / low));
}

/** Powers of ten within a range; where there are fewer than three, also twice and five times those. */
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

/** A range with some room around positive values, for a logarithmic axis. */
export function logRange(values: readonly (number | null | undefined)[]): [number, number] {
  const usable = values.filter((v): v is number => v != null && Number.isFinite(v) && v > 0);
  if (usable.length === 0) return [0.01, 1];
  const [low, high] = [Math.min(...usable) / 1.4, Math.max(...usable) * 1.4];
  return high / low < 4 ? [low / 2, high * 2] : [low, high];
}
