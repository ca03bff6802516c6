/** Settings of a run: keys, ranges, choices and defaults as the engine has them, and their names on the page. */
import type {
  Alignment,
  DifferenceDefinition,
  Field,
  FitChoice,
  LinkKey,
  Plausibility,
  Pooling,
  Sampler,
  Settings,
} from "../../worker/protocol";
import table from "../../worker/settings.json";
import { countIn, decimalIn, pointed, seedIn, shareIn } from "../text/values";
import { completed } from "./preparation";

/** Every setting that has a key in links, in their order (src/settings/fields.rs). */
export const FIELDS = table.fields as Field[];

/** Every key of links, with what its value may be (src/settings/links.rs). */
export const LINK_KEYS = table.linkKeys as LinkKey[];

/** Bounds of the numbers of the lessons' scenes (src/lessons/scene.rs). */
export const SCENE_BOUNDS = table.sceneBounds;

/** Digits of a fingerprint in a link that are compared. */
export const HASH_DIGITS = table.hashDigits;

/** Version of the engine, as links name it; and the first that chooses σ as this one does. */
export const { engine: ENGINE, sigmaSince: SIGMA_SINCE } = table;

export const DEFAULTS: Settings = defaults();

function defaults(): Settings {
  const { sigmaRecommended, ...settings } = table.defaults;
  return settings as Settings;
}

/** The choices of a setting with their explanations, the default first. */
export type Options<T extends string> = Record<T, { label: string; help: string }>;

export const SAMPLERS: Options<Sampler> = {
  auto: {
    label: "Auto",
    help: "Independence if the Gaussian fit is good, else Hamiltonian; the results state which ran and why.",
  },
  variational: {
    label: "Gaussian fit alone",
    help: "No chains: shapes are drawn from the Gaussian N(μ, Λ⁻¹) closest to the target.",
  },
  independence: {
    label: "Independence",
    help: "Each proposal is an independent draw from the Gaussian fit, accepted by the ratio of target to fit: nearly independent draws.",
  },
  hmc: {
    label: "Hamiltonian",
    help: "Hamiltonian Monte Carlo with the gradient of the target; the Gaussian part of each trajectory is computed exactly.",
  },
  mala: {
    label: "Langevin",
    help: "MALA: a random step plus half a step along the gradient, scaled by the fit, then accepted or rejected.",
  },
  pcn: {
    label: "Crank–Nicolson",
    help: "Proposals μ + √(1−β²)·(a−μ) + β·noise leave the Gaussian fit invariant and are accepted by the ratio of target to fit.",
  },
  paper: {
    label: "Paper’s random walk",
    help: "As published: a mixture of random-walk proposals whose scaling move is accepted as if it were symmetric.",
  },
  "paper-corrected": {
    label: "Paper’s, corrected",
    help: "The same random walk with the Hastings factor that its scaling move needs.",
  },
};

export const FITS: Options<FitChoice> = {
  auto: { label: "Auto", help: "Variational, unless trial draws show that another fit is better." },
  variational: {
    label: "Variational",
    help: "The Gaussian closest to the target, with the distance averaged over the Gaussian itself.",
  },
  reweighted: {
    label: "Reweighted",
    help: "The mean distance is replaced by a weighted sum of squares, with weights updated until they converge.",
  },
  laplace: {
    label: "Laplace",
    help: "The mode of the target and the curvature of its logarithm there.",
  },
  rms: {
    label: "RMS",
    help: "The mean distance is replaced by the root mean square: closed form, less accurate.",
  },
};

export const SIDES_USED: Options<Pooling> = {
  both: { label: "Both", help: "Shapes of A near B and shapes of B near A, in equal numbers." },
  a: { label: "A alone", help: "Only shapes of A that lie near B." },
  b: { label: "B alone", help: "Only shapes of B that lie near A." },
};

export const PLAUSIBILITIES: Options<Plausibility> = {
  product: {
    label: "Product",
    help: "As in the paper: the plausibilities in A and in B are multiplied. The intersection of a model with itself has half its variance.",
  },
  idempotent: {
    label: "Idempotent",
    help: "The geometric mean of the plausibilities in A and in B: the intersection of a model with itself is the model.",
  },
};

/** The definitions of the difference; comparison/words.ts explains them. */
export const DIFFERENCES = choicesOf("difference") as DifferenceDefinition[];

/** The names that a setting can have. */
export function choicesOf(name: Field["name"]): readonly string[] {
  const value = FIELDS.find((field) => field.name === name)?.value;
  return value?.kind === "choice" ? value.of : [];
}

export const ALIGNMENTS: Options<Alignment> = {
  none: {
    label: "As they stand",
    help: "No alignment: the models already share one coordinate frame.",
  },
  rigid: { label: "Rigid", help: "B is rotated and translated onto A; its size stays." },
  similarity: { label: "With scale", help: "B is rotated, translated and scaled onto A." },
};

/** Default numbers of chains, draws and steps of each sampler; the random walk has those of the paper. */
export function budgetOf(sampler: Sampler): Pick<Settings, "chains" | "draws" | "burnIn" | "thin"> {
  return table.budgets[sampler];
}

/** Smallest and largest value of a count. */
export function rangeOf(name: Field["name"]): [number, number] {
  const value = FIELDS.find((field) => field.name === name)?.value;
  return value && "least" in value ? [value.least, value.most] : [0, 0];
}

/** Smallest and largest number of draws per model; every chain has its least. */
export function rangeOfDraws(chains: number): [number, number] {
  const [, most] = rangeOf("draws");
  return [table.leastDrawsOfAChain * chains, most];
}

/** Smallest and largest number of compared points. */
export const SUBSAMPLE = [3, 10_000_000] as const;

/** Reads a positive length or ratio; null if nothing is typed. */
export function parsePositive(text: string): number | null | "invalid" {
  const trimmed = text.trim().toLowerCase();
  if (trimmed === "" || trimmed === "auto") return null;
  const value = decimalIn(trimmed);
  return value !== null && value > 0 ? value : "invalid";
}

/** Reads a share typed as per cent, from 0 to below 100. */
export function parsePercent(text: string): number | "invalid" {
  const share = shareOf(text);
  return share !== null && share >= 0 && share < 1 ? share : "invalid";
}

/** Reads a share of the variance as per cent, above 0 and at most 100. */
export function parseVariance(text: string): number | "invalid" {
  const share = shareOf(text);
  return share !== null && share > 0 && share <= 1 ? share : "invalid";
}

function shareOf(text: string): number | null {
  return shareIn(pointed(text.trim().replace(/\s*%$/, "")) ?? "");
}

/** A share as it is typed. */
export function percentText(share: number): string {
  return String(Number((100 * share).toPrecision(12)));
}

export function parseSeed(text: string): string | "invalid" {
  return seedIn(text.trim()) ?? "invalid";
}

export function parseCount(text: string, least: number, most: number): number | "invalid" {
  return countIn(text.trim(), least, most) ?? "invalid";
}

const KEYS = Object.keys(DEFAULTS).sort() as (keyof Settings)[];

/** Key of settings: two runs with the same models and key have the same draws. */
export function settingsKey(settings: Settings): string {
  return JSON.stringify(KEYS.map((key) => sorted(settings[key])));
}

/** A value with the keys of every object sorted. */
function sorted(value: unknown): unknown {
  if (typeof value !== "object" || value === null || Array.isArray(value)) return value;
  const entries = Object.entries(value).sort(([one], [other]) => (one < other ? -1 : 1));
  return entries.map(([name, inner]) => [name, sorted(inner)]);
}

/** The settings of a report as they were chosen: null for a recommended σ. */
export function settingsOf(
  report: Partial<Settings> & { sigma: number | null; sigmaRecommended: boolean },
): Settings {
  const { sigmaRecommended, sigma, prepare, ...rest } = report;
  return {
    ...DEFAULTS,
    ...rest,
    prepare: completed(prepare),
    sigma: sigmaRecommended ? null : sigma,
  };
}
