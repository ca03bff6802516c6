/** Formats numbers, shares, lengths, angles, durations, sizes and lists as text. */

export function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** “one, two and three”. */
export function listed(words: string[]): string {
  return words.length < 2 ? words.join("") : `${words.slice(0, -1).join(", ")} and ${words.at(-1)}`;
}

/** A number with three significant digits, not in scientific notation between 0.001 and 10⁶. */
export function number(value: number, digits = 3): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  // Of the rounded value: 0.9999 is shown as 1.00.
  const size = Math.abs(Number(value.toPrecision(digits)));
  if (size >= 1e6 || size < 1e-3) return scientific(value, digits);
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  return minus(group(value.toFixed(Math.min(decimals, 6))));
}

/** Replaces rounding error, relative to a size, by 0. */
export function withoutRoundingError(value: number, size: number): number {
  return Math.abs(value) < 1e-9 * size ? 0 : value;
}

/** A number with its sign. */
export function signed(value: number): string {
  return value > 0 ? `+${number(value)}` : number(value);
}

export function count(value: number): string {
  return group(Math.round(value).toString());
}

/** A share as per cent; never “100 %” for less than all, nor “0 %” for more than none. */
export function percent(share: number): string {
  if (!Number.isFinite(share)) return "–";
  const value = 100 * share;
  if (value > 0 && value < 0.01) return "< 0.01\u202f%";
  if (value < 100 && value > 99.99) return "> 99.99\u202f%";
  const decimals = value > 99 && value < 100 ? 2 : value < 1 ? 2 : value < 10 ? 1 : 0;
  if (value === 0) return "0\u202f%";
  return `${value.toFixed(decimals)}\u202f%`;
}

export function length(value: number, unit: string): string {
  return `${number(value)}\u202f${unit}`;
}

/** A mean and its standard deviation, both to the same decimal: that of the second digit of the spread, at most the sixth. */
export function plusMinus(mean: number, spread: number): { mean: string; spread: string } {
  const found = Math.max(Math.abs(spread), 1e-3 * Math.min(1, Math.abs(mean)));
  // Rounding error has no digits.
  const finest = found < 1e-9 ? 1e-3 : found;
  const decimals = Math.min(6, Math.max(0, 1 - Math.floor(Math.log10(finest))));
  return { mean: minus(mean.toFixed(decimals)), spread: spread.toFixed(decimals) };
}

/** An angle in degrees; rounding error is shown as 0. */
export function degrees(angle: number): string {
  if (angle < 0.005) return "0°";
  return `${angle.toFixed(angle < 1 ? 2 : angle < 10 ? 1 : 0)}°`;
}

/** “about 12 s”, “about 3 min”. */
export function duration(seconds: number): string {
  if (!Number.isFinite(seconds) || seconds < 0) return "–";
  if (seconds < 1) return "under 1\u202fs";
  if (seconds < 90) return `${Math.round(seconds)}\u202fs`;
  if (seconds < 5400) return `${Math.round(seconds / 60)}\u202fmin`;
  return `${(seconds / 3600).toFixed(1)}\u202fh`;
}

export function bytes(value: number): string {
  if (value < 1e6) return `${Math.max(1, Math.round(value / 1e3))}\u202fkB`;
  return `${number(value / 1e6)}\u202fMB`;
}

function scientific(value: number, digits: number): string {
  const [mantissa = "", exponent = ""] = value.toExponential(digits - 1).split("e");
  const raised = [...String(Number(exponent))].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)] ?? "⁻").join("");
  return minus(`${mantissa} × 10${raised}`);
}

function group(text: string): string {
  const [whole = "", fraction] = text.split(".");
  const grouped = whole.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, "\u202f") : whole;
  return fraction === undefined ? grouped : `${grouped}.${fraction}`;
}

function minus(text: string): string {
  return text.replace("-", "−");
}
