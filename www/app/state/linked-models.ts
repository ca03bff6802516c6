/** Type of the two models of a link. */
export type Each<T> = Record<"a" | "b", T>;

export const NONE: Each<null> = { a: null, b: null };

export interface LinkedModels {
  /**
   * `https:…`, an address relative to the page, or `demo:NAME` of an example model; null for the visitor's own file.
   * Null as a whole for an example pair.
   */
  urls: Each<string | null> | null;
  /** Parts of the files at these addresses; null for the first. */
  parts: Each<string | null>;
  /** How these files are read where they do not say so; null for nothing said. */
  readings: Each<string | null>;
  /** Names of the visitor's own files, unless they are left out. */
  names: Each<string | null>;
  /** Start of each fingerprint, to check the opened models. */
  hashes: Each<string | null>;
}

export function noLinkedModels(): LinkedModels {
  return { urls: null, parts: NONE, readings: NONE, names: NONE, hashes: NONE };
}
