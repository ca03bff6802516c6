/** Which two models a link is about. */
export type Each<T> = Record<"a" | "b", T>;

export const NONE: Each<null> = { a: null, b: null };

export interface LinkedModels {
  /**
   * `https:…`, an address beside the page, or `demo:NAME` of one model that comes with it; null for a file of
   * one's own. Null as a whole for a pair that comes with the page.
   */
  urls: Each<string | null> | null;
  /** Parts of the files at these addresses; null for the first. */
  parts: Each<string | null>;
  /** What files of one's own are called, unless that is left out. */
  names: Each<string | null>;
  /** Start of each fingerprint, to tell whether what is opened is the same. */
  hashes: Each<string | null>;
}

export function noLinkedModels(): LinkedModels {
  return { urls: null, parts: NONE, names: NONE, hashes: NONE };
}
