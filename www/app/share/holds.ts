/** Sentences about what a link contains and what it does not. Pure. */

export interface Unlinkable {
  /** Which of A and B are the visitor's own files. */
  files: ("a" | "b")[];
  /** Whether other models of the visitor are open. */
  modelList: boolean;
  /** Whether shapes are given beside A or B. */
  shapes: boolean;
  /** Whether the compared points are a list too long for a link. */
  points: boolean;
}

/** Message after copying a link. */
export function copiedWords({ files, modelList, shapes, points }: Unlinkable): string {
  if (files.length > 0) return "Link copied; it contains no files";
  return modelList || shapes || points
    ? "Link copied; it does not contain everything"
    : "Link copied";
}

export function holdsSentences({ files, modelList, shapes, points }: Unlinkable): string[] {
  const said = [holds(files)];
  if (shapes) {
    said.push(
      "The shapes that were added to the models are not in the link: σ and what is more than chance depend on them.",
    );
  }
  if (modelList) said.push("Your own models other than A and B are not in the link.");
  if (points) said.push("The list of compared points is too long for a link: use a run file.");
  return said;
}

function holds(files: Unlinkable["files"]): string {
  if (files.length === 0) {
    return "The link contains the models, all settings and the view: everyone who opens it sees the same numbers.";
  }
  const [which, them, are] =
    files.length === 2
      ? ["fingerprints of your two files, not the files", "the same files", "they are"]
      : [
          `fingerprint of your file, ${files[0]?.toUpperCase()}, not the file`,
          "the same file",
          "it is",
        ];
  return `The link contains all settings and the ${which}. To open it, drop ${them}; the page checks that ${are} the same.`;
}
