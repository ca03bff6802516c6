/**
 * Writes and reads the two models of a link: a pair that comes with the page, addresses, or names and fingerprints
 * of the visitor's own files. Pure.
 */
import { DEMO_MODELS } from "../../state/demos";
import { type Each, type LinkedModels, noLinkedModels } from "../../state/linked-models";
import { looksLikeAddress } from "./address";

/** Digits of a fingerprint in a link: enough that two models hardly ever share them. */
export const HASH_DIGITS = 16;

export function writeModels(models: LinkedModels): [string, string][] {
  const { urls, parts, readings, names, hashes } = models;
  if (!urls) return [];
  const each = (key: string, of: Each<string | null>) =>
    (["a", "b"] as const).flatMap((side): [string, string][] => {
      const value = of[side];
      return value === null ? [] : [[`${key}${side}`, value]];
    });
  return [
    ...each("", urls),
    ...each("name-", names),
    ...each("hash-", hashes),
    ...each("part-", parts),
    ...each("read-", readings),
  ];
}

export function readModels(given: URLSearchParams): LinkedModels {
  const each = <T>(read: (side: "a" | "b") => T): Each<T> => ({ a: read("a"), b: read("b") });
  const parts = each((side) => given.get(`part-${side}`));
  const readings = each((side) => given.get(`read-${side}`) || null);
  const urls = each((side) => addressIn(given, side));
  const names = each((side) => (given.has(side) ? null : given.get(`name-${side}`) || null));
  const hashes = each((side) => hashIn(given.get(`hash-${side}`)));
  // Without an address, a name or a hash the link names no model.
  const said = each(
    (side) => urls[side] ?? (given.has(side) ? null : (names[side] ?? hashes[side])),
  );
  if (said.a === null || said.b === null) return { ...noLinkedModels(), parts, readings };
  return { urls, parts, readings, names, hashes };
}

/** The invalid addresses of a link, as `key=value`. */
export function misreadAddresses(given: URLSearchParams): string[] {
  return (["a", "b"] as const).flatMap((side) =>
    given.has(side) && addressIn(given, side) === null ? [`${side}=${given.get(side)}`] : [],
  );
}

function addressIn(given: URLSearchParams, side: "a" | "b"): string | null {
  const text = given.get(side) ?? "";
  if (text.startsWith("demo:")) return DEMO_MODELS.includes(text.slice(5)) ? text : null;
  return looksLikeAddress(text) ? text : null;
}

function hashIn(text: string | null): string | null {
  const digits = text?.toLowerCase() ?? "";
  return /^[0-9a-f]{8,32}$/.test(digits) ? digits.slice(0, HASH_DIGITS) : null;
}
