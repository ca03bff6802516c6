/** What a link holds and what it does not, in words. Pure. */

export interface Unlinkable {
  /** Sides that are files of the visitor's own. */
  files: ("a" | "b")[];
  /** Whether other such models are open besides. */
  modelList: boolean;
  /** Whether the points that are compared are a list too long for a link. */
  points: boolean;
}

/** In a line, once it is copied. */
export function copiedWords({ files, modelList, points }: Unlinkable): string {
  if (files.length > 0) return "Link copied; it holds no files";
  return modelList || points ? "Link copied; not all is in it" : "Link copied";
}

export function holdsSentences({ files, modelList, points }: Unlinkable): string[] {
  const said = [holds(files)];
  if (modelList) said.push("Models of your own beside A and B are not in it.");
  if (points) said.push("Which points are compared is a list too long for a link: use a run file.");
  return said;
}

function holds(files: Unlinkable["files"]): string {
  if (files.length === 0) {
    return "The link holds the models, every setting and how it is looked at: whoever opens it sees the same numbers.";
  }
  const [which, them, are] =
    files.length === 2
      ? ["fingerprints of your two files, not the files", "the same files", "they are"]
      : [
          `fingerprint of your file, ${files[0]?.toUpperCase()}, not the file`,
          "the same file",
          "it is",
        ];
  return `The link has all settings and the ${which}. Whoever opens it drops ${them}, and the page checks that ${are} the same.`;
}
