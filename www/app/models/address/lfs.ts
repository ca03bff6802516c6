/**
 * Git LFS keeps large files beside a repository and puts a pointer in their place: a short text with the
 * SHA-256 and the size of what is meant. Pure. See github.com/git-lfs/git-lfs/blob/main/docs/spec.md.
 */
export interface Pointer {
  sha256: string;
  size: number;
}

/** By the specification pointers are shorter than this. */
export const LONGEST_POINTER = 1024;

const FIRST_LINE = "version https://git-lfs.github.com/spec/v1\n";

/** What a text points to; null where it is no pointer. */
export function pointerIn(text: string): Pointer | null {
  if (text.length >= LONGEST_POINTER || !text.startsWith(FIRST_LINE)) return null;
  const sha256 = /^oid sha256:([0-9a-f]{64})$/m.exec(text)?.[1];
  const size = /^size (\d{1,15})$/m.exec(text)?.[1];
  return sha256 && size ? { sha256, size: Number(size) } : null;
}

/** Where the file itself is; null where that cannot be known. The host of GitHub's sends `*` to other sites. */
export function behindPointer(url: URL): URL | null {
  if (url.host !== "raw.githubusercontent.com") return null;
  return new URL(`https://media.githubusercontent.com/media${url.pathname}`);
}
