/** Writes the shown comparison as a command for the terminal. Pure. */
import type { Settings, SidePreparation, Sides } from "../../worker/protocol";
import { budgetOf, DEFAULTS } from "../state/settings";

/** A model as an argument of the command line. */
export interface CommandModel {
  /** `demo:NAME`, or the name of a file. */
  source: string;
  /** Part of the file; null for the first. */
  part: string | null;
  /** How it was read, "" for nothing said. */
  reading: string;
  /** What the shapes beside it are called. */
  shapes?: string | null;
}

export interface Command {
  line: string;
  /** Settings that the command line has no flag for; a run file has them. */
  missing: string[];
}

const FLAGS = {
  sigma: "sigma",
  seed: "seed",
  chains: "chains",
  draws: "draws",
  burnIn: "burn-in",
  thin: "thin",
  fit: "fit",
  weighted: "weighted",
  pooling: "pooling",
  plausibility: "plausibility",
  noise: "noise",
  difference: "difference",
  differenceQuantile: "difference-quantile",
  differenceThreshold: "difference-threshold",
  differenceDraws: "difference-draws",
  modes: "modes",
  align: "align",
  permutations: "permutations",
} as const;

export function commandOf(settings: Settings, models: Sides<CommandModel>): Command {
  const standard = { ...DEFAULTS, ...budgetOf(settings.sampler) };
  const words = ["shapevenn", "compare", modelWord(models.a), modelWord(models.b)];
  if (settings.sampler !== DEFAULTS.sampler) words.push("--sampler", settings.sampler);
  for (const [name, flag] of Object.entries(FLAGS) as [keyof typeof FLAGS, string][]) {
    const value = settings[name];
    if (value !== standard[name] && value !== null) words.push(`--${flag}`, String(value));
  }
  for (const side of ["a", "b"] as const) {
    const { shapes } = models[side];
    if (shapes) words.push(`--training-${side}`, shapes);
  }
  const missing: string[] = [];
  words.push(...preparation(settings, missing));
  if (models.a.reading === models.b.reading) {
    if (models.a.reading !== "") words.push("--read", models.a.reading);
  } else {
    for (const side of ["a", "b"] as const) {
      if (models[side].reading !== "") words.push(`--read-${side}`, models[side].reading);
    }
  }
  return { line: words.map(quoted).join(" "), missing };
}

/** Flags for the preparation of the models; settings without a flag go to `missing`. */
function preparation({ prepare }: Settings, missing: string[]): string[] {
  const { a, b, convert, mirror, points, subsample } = prepare;
  const words: string[] = [];
  const eitherSide = (say: (side: SidePreparation) => boolean) => say(a) || say(b);
  if (a.unit !== null) words.push("--unit-a", a.unit);
  if (b.unit !== null) words.push("--unit-b", b.unit);
  if (convert) words.push("--convert-units");
  if (mirror) words.push("--mirror");
  if (eitherSide(({ modes }) => modes !== null)) missing.push("a number of modes for one model");
  if (a.variance !== null && a.variance === b.variance) {
    words.push("--variance", String(a.variance));
  } else if (eitherSide(({ variance }) => variance !== null)) {
    missing.push("a share of the variance for one model");
  }
  if (a.rebase && b.rebase) missing.push("both models on the mean of the other");
  else if (a.rebase || b.rebase) words.push("--rebase", a.rebase ? "a" : "b");
  if (points?.by === "map") words.push("--crop-map");
  if (points?.by === "region") words.push("--region", points.ranges);
  if (points?.by === "list") missing.push("the list of points");
  if (subsample !== null) words.push("--subsample", String(subsample));
  return words;
}

function modelWord({ source, part }: CommandModel): string {
  return part === null ? source : `${source}#${part}`;
}

/** Quotes a word for a POSIX shell. */
function quoted(word: string): string {
  return /^[\w./:@%+=,-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}
