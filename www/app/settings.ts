/** Settings of a run: the defaults and ranges of src/comparison/settings.rs, for the page. */
import type { Alignment, SamplerName, Settings } from "../worker/protocol";

export const DEFAULTS: Settings = {
  sigma: null,
  seed: "1",
  sampler: "independence",
  ...budgetOf("independence"),
  modes: null,
  align: "none",
};

export const SAMPLERS: Record<SamplerName, { label: string; help: string }> = {
  independence: {
    label: "Independence",
    help: "Proposals from a Gaussian fitted to the target. Fast, and nearly independent draws.",
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

export const ALIGNMENTS: Record<Alignment, { label: string; help: string }> = {
  none: { label: "As they stand", help: "The models already share one coordinate frame." },
  rigid: { label: "Rigid", help: "Turn and shift B onto A; keep its size." },
  similarity: { label: "With scale", help: "Turn, shift and scale B onto A." },
};

/** What each sampler runs unless told otherwise: the random walk has the paper’s budget. */
export function budgetOf(
  sampler: SamplerName,
): Pick<Settings, "chains" | "draws" | "burnIn" | "thin"> {
  return sampler === "independence"
    ? { chains: 8, draws: 4000, burnIn: 10, thin: 1 }
    : { chains: 25, draws: 2500, burnIn: 2000, thin: 30 };
}

export const SEED_LIMIT = 2n ** 64n;

/** The value typed for σ, the recommended one where nothing is typed. */
export function parseSigma(text: string): number | null | "invalid" {
  const trimmed = text.trim().replace(",", ".");
  if (trimmed === "" || trimmed === "auto") return null;
  const value = Number(trimmed);
  return Number.isFinite(value) && value > 0 ? value : "invalid";
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

/** Two runs with the same models and the same key draw the same. */
export function settingsKey(settings: Settings): string {
  const { sigma, seed, sampler, chains, draws, burnIn, thin, modes, align } = settings;
  return JSON.stringify([sigma, seed, sampler, chains, draws, burnIn, thin, modes, align]);
}

/** The settings that led to a report: σ is left to the engine where it had chosen it. */
export function settingsOf(report: Settings & { sigmaRecommended: boolean }): Settings {
  const { sigmaRecommended, sigma, ...rest } = report;
  return { ...rest, sigma: sigmaRecommended ? null : sigma };
}
