/** Names of samplers, proposals and models in the scenes. */
import type { LessonSampler } from "../../../worker/protocol";

export const SAMPLER_NAMES: Record<LessonSampler, string> = {
  paper: "Paper’s walk, as published",
  "paper-corrected": "Paper’s walk, corrected",
  mala: "Langevin (MALA)",
  hmc: "Hamiltonian (HMC)",
  independence: "Independence",
  pcn: "Crank–Nicolson",
  rejection: "Rejection",
};

/** A component of the paper’s mixture of proposals: its weight and its proposal. */
export interface MixturePart {
  share: number;
  /** Standard deviation of the step, in coefficients. */
  deviation: number;
  name: string;
  about: string;
}

export const MIXTURE: readonly MixturePart[] = [
  { share: 0.1, deviation: 0.2, name: "wide", about: "a Gaussian step of SD 0.2" },
  { share: 0.5, deviation: 0.1, name: "medium", about: "a Gaussian step of SD 0.1" },
  { share: 0.2, deviation: 0.025, name: "small", about: "a Gaussian step of SD 0.025" },
  {
    share: 0.2,
    deviation: 0.2,
    name: "scaling",
    about: "α is scaled, its direction is kept",
  },
];
/** The component of the mixture that scales α. */
export const SCALING = 3;

/** The pairs of stars of the paper’s table 1, with the common range of the first tip, and the planes. */
export const PAIR_NAMES: Record<string, string> = {
  planes: "Two planes",
  "stars-1": "Stars 1 (±5°)",
  "stars-2": "Stars 2 (±5°)",
  "stars-3": "Stars 3 (±10°)",
  "stars-4": "Stars 4 (±10°)",
  "stars-5": "Stars 5 (±20°)",
  "stars-6": "Stars 6 (±40°)",
};
