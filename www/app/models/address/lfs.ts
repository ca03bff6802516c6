/**
 * Reads Git LFS pointers: short texts with the SHA-256 and the size of a large file that is stored outside of the
 * repository. Pure. See github.com/git-lfs/git-lfs/blob/main/docs/spec.md.
 */
export interface Pointer {
  sha256: string;
  size: number;
}

/** By the specification pointers are shorter than this. */
export const LONGEST_POINTER = 1024;

const FIRST_LINE = "version https://git-lfs.github.com/spec/v1\n";

/** The pointer in a text; null if it is none. */
export function pointerIn(text: string): Pointer | null {
  if (text.length >= LONGEST_POINTER || !text.startsWith(FIRST_LINE)) return null;
  const sha256 = /^oid sha256:([0-9a-f]{64})$/m.exec(text)?.[1];
  const size = /^size (\d{1,15})$/m.exec(text)?.[1];
  return sha256 && size ? { sha256, size: Number(size) } : null;
}

/** Address of the file itself; null if unknown. The host for GitHub lets all sites read its files. */
export function behindPointer(url: URL): URL | null {
  if (url.host !== "raw.githubusercontent.com") return null;
  return new URL(`https://media.githubusercontent.com/media${url.pathname}`);
}
