/** Settings of a run: the defaults and ranges of src/settings.rs, for the page. */
import type {
  Alignment,
  DifferenceName,
  FitChoice,
  Plausibility,
  Pooling,
  SamplerName,
  Settings,
} from "../../worker/protocol";
import { completed, UNPREPARED } from "./preparation";

export const DEFAULTS: Settings = {
  sigma: null,
  noise: null,
  seed: "1",
  sampler: "auto",
  fit: "auto",
  pooling: "both",
  plausibility: "product",
  ...budgetOf("auto"),
  weighted: 1024,
  difference: "soft",
  differenceQuantile: 0.8,
  differenceThreshold: null,
  differenceDraws: 2000,
  modes: null,
  align: "none",
  prepare: UNPREPARED,
};

/** Choices of one setting, the default first. */
export type Options<T extends string> = Record<T, { label: string; help: string }>;

export const SAMPLERS: Options<SamplerName> = {
  auto: {
    label: "Auto",
    help: "Independence where the Gaussian fit is good, else Hamiltonian; the results say which ran and why.",
  },
  variational: {
    label: "Gaussian fit alone",
    help: "No chains: shapes drawn from the Gaussian N(μ, Λ⁻¹) that lies closest to the target.",
  },
  independence: {
    label: "Independence",
    help: "Each proposal is a fresh draw from the Gaussian fit, accepted by the ratio of target to fit: nearly independent draws.",
  },
  hmc: {
    label: "Hamiltonian",
    help: "Shapes glide along the gradient of the target; the Gaussian part of the path is followed exactly.",
  },
  mala: {
    label: "Langevin",
    help: "A random step plus half a step along the gradient, scaled by the fit, then accepted or not.",
  },
  pcn: {
    label: "Crank–Nicolson",
    help: "μ + √(1−β²)·(a−μ) + β·noise: steps that keep the Gaussian fit and are accepted by what it misses.",
  },
  paper: {
    label: "Paper’s random walk",
    help: "As published: a random-walk mixture whose scaling move is accepted as if it were symmetric.",
  },
  "paper-corrected": {
    label: "Paper’s, corrected",
    help: "The same random walk with the factor that its scaling move needs.",
  },
};

export const FITS: Options<FitChoice> = {
  auto: { label: "Auto", help: "Variational, unless a few trial draws show another to be better." },
  variational: {
    label: "Variational",
    help: "The Gaussian closest to the target, with the distance averaged over the Gaussian itself.",
  },
  reweighted: {
    label: "Reweighted",
    help: "The mean distance replaced by a weighted sum of squares, weighted anew until it settles.",
  },
  laplace: {
    label: "Laplace",
    help: "The most plausible shape, and the curvature of the target there.",
  },
  rms: {
    label: "RMS",
    help: "The mean distance replaced by the root mean square: exact algebra, rough.",
  },
};

export const SIDES_USED: Options<Pooling> = {
  both: { label: "Both", help: "Shapes of A near B and shapes of B near A, in equal shares." },
  a: { label: "A alone", help: "Only shapes of A that lie near B." },
  b: { label: "B alone", help: "Only shapes of B that lie near A." },
};

export const PLAUSIBILITIES: Options<Plausibility> = {
  product: {
    label: "Product",
    help: "The paper’s: both plausibilities multiplied. A model compared with itself keeps half its variance.",
  },
  idempotent: {
    label: "Idempotent",
    help: "Their geometric mean: a model compared with itself stays itself.",
  },
};

/** What each means is said in words.ts. */
export const DIFFERENCES: DifferenceName[] = ["soft", "distance", "relative", "outside"];

export const ALIGNMENTS: Options<Alignment> = {
  none: { label: "As they stand", help: "The models already share one coordinate frame." },
  rigid: { label: "Rigid", help: "Turn and shift B onto A; keep its size." },
  similarity: { label: "With scale", help: "Turn, shift and scale B onto A." },
};

/** What each sampler runs unless told otherwise: the random walk has the paper’s budget. */
export function budgetOf(
  sampler: SamplerName,
): Pick<Settings, "chains" | "draws" | "burnIn" | "thin"> {
  switch (sampler) {
    case "hmc":
      return { chains: 16, draws: 4000, burnIn: 200, thin: 1 };
    case "mala":
    case "pcn":
      return { chains: 16, draws: 4000, burnIn: 500, thin: 4 };
    case "paper":
    case "paper-corrected":
      return { chains: 25, draws: 2500, burnIn: 2000, thin: 30 };
    default:
      return { chains: 8, draws: 4000, burnIn: 10, thin: 1 };
  }
}

/** Smallest and largest value of each count. */
export const RANGES = {
  chains: [2, 1024],
  burnIn: [0, 10_000_000],
  thin: [1, 100_000],
  weighted: [1024, 10_000_000],
  differenceDraws: [32, 10_000_000],
  modes: [1, 100_000],
} as const;

/** Fewer points than this say nothing of a shape. */
export const SUBSAMPLE = [3, 10_000_000] as const;

export const MOST_DRAWS = 10_000_000;

/** Each chain has at least eight draws. */
export function leastDraws(chains: number): number {
  return 8 * chains;
}

export const SEED_LIMIT = 2n ** 64n;

/** A positive length or ratio; null where nothing is typed. */
export function parsePositive(text: string): number | null | "invalid" {
  const trimmed = text.trim().replace(",", ".");
  if (trimmed === "" || trimmed === "auto") return null;
  const value = Number(trimmed);
  return Number.isFinite(value) && value > 0 ? value : "invalid";
}

/** A share typed as per cent, from 0 to below 100. */
export function parsePercent(text: string): number | "invalid" {
  const trimmed = text.replace("%", "").trim().replace(",", ".");
  const value = trimmed === "" ? Number.NaN : Number(trimmed);
  return value >= 0 && value < 100 ? Number((value / 100).toPrecision(12)) : "invalid";
}

/** As it is typed. */
export function percentText(share: number): string {
  return String(Number((100 * share).toPrecision(12)));
}

export function parseSeed(text: string): string | "invalid" {
  const trimmed = text.trim();
  if (!/^\d{1,20}$/.test(trimmed)) return "invalid";
  const value = BigInt(trimmed);
  return value < SEED_LIMIT ? value.toString() : "invalid";
}

export function parseCount(text: string, least: number, most: number): number | "invalid" {
  const trimmed = text.trim();
  if (!/^\d+$/.test(trimmed)) return "invalid";
  const value = Number(trimmed);
  return value >= least && value <= most ? value : "invalid";
}

const KEYS = Object.keys(DEFAULTS).sort() as (keyof Settings)[];

/** Two runs with the same models and the same key draw the same. */
export function settingsKey(settings: Settings): string {
  return JSON.stringify(KEYS.map((key) => sorted(settings[key])));
}

/** The same with the names of every object in order, whoever wrote it. */
function sorted(value: unknown): unknown {
  if (typeof value !== "object" || value === null || Array.isArray(value)) return value;
  const entries = Object.entries(value).sort(([one], [other]) => (one < other ? -1 : 1));
  return entries.map(([name, inner]) => [name, sorted(inner)]);
}

/** The settings that led to a report: σ is left to the engine where it had chosen it. */
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
