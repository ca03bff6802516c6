/**
 * Writes and reads the two models of a link: a pair that comes with the page, addresses, or names and fingerprints
 * of the visitor's own files. Pure.
 */
import { type Each, type LinkedModels, noLinkedModels } from "../../state/linked-models";
import { HASH_DIGITS } from "../../state/settings";

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
  const parts = each((side) => given.get(`part-${side}`) || null);
  const readings = each((side) => given.get(`read-${side}`) || null);
  const urls = each((side) => given.get(side));
  const names = each((side) => (given.has(side) ? null : given.get(`name-${side}`) || null));
  const hashes = each((side) => hashIn(given.get(`hash-${side}`)));
  // Without an address, a name or a hash the link names no model.
  const said = each(
    (side) => urls[side] ?? (given.has(side) ? null : (names[side] ?? hashes[side])),
  );
  if (said.a === null || said.b === null) return { ...noLinkedModels(), parts, readings };
  return { urls, parts, readings, names, hashes };
}

/** As much of a fingerprint as is compared; what is none was taken out of the link when it was read. */
function hashIn(text: string | null): string | null {
  return text === null ? null : text.toLowerCase().slice(0, HASH_DIGITS);
}
