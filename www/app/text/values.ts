/**
 * Reads values as they are written in a link or typed: numbers, counts, seeds, per cent. The engine has the same grammar
 * (src/settings/values.rs), but links are read before it is there; both run the cases of tests/fixtures/grammar.json. Pure.
 */

const NUMBER = /^-?(?:\d+(?:\.\d+)?|\.\d+)(?:e[+-]?\d+)?$/i;

/** A finite number with a decimal point. */
export function numberIn(text: string): number | null {
  const value = NUMBER.test(text) ? Number(text) : Number.NaN;
  return Number.isFinite(value) ? value : null;
}

/** A number that may have a decimal comma. */
export function decimalIn(text: string): number | null {
  return numberIn(text) ?? numberIn(pointed(text.trim()) ?? "");
}

/** The number with a decimal point for a decimal comma; null if the comma may separate thousands. */
export function pointed(text: string): string | null {
  const at = text.indexOf(",");
  if (at < 0) return text;
  const [whole, rest] = [text.slice(0, at), text.slice(at + 1)];
  const fraction = rest.split(/e/i)[0] ?? "";
  const thousands = /^-?[1-9]\d{0,2}$/.test(whole) && fraction.length === 3;
  return !thousands && /^-?\d+$/.test(whole) && /^\d+$/.test(fraction) ? `${whole}.${rest}` : null;
}

/** A whole number in a range. */
export function countIn(text: string, least: number, most: number): number | null {
  const value = /^\d+$/.test(text) ? Number(text) : Number.NaN;
  return value >= least && value <= most ? value : null;
}

const SEED_LIMIT = 2n ** 64n;

/** A whole number below 2⁶⁴, without zeros before it. */
export function seedIn(text: string): string | null {
  if (!/^\d{1,20}$/.test(text)) return null;
  const value = BigInt(text);
  return value < SEED_LIMIT ? value.toString() : null;
}

/** A share from per cent, with the twelve digits that a link keeps. */
export function shareIn(text: string): number | null {
  const percent = numberIn(text);
  return percent === null ? null : Number((percent / 100).toPrecision(12));
}
