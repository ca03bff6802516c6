/** The scenes of the lessons, in their order, with the schema of their parameters. */
import { choice, count, flag, list, number, type Schema, seed, type Values } from "./params";

export const STAR_PAIRS = [
  "stars-1",
  "stars-2",
  "stars-3",
  "stars-4",
  "stars-5",
  "stars-6",
] as const;
export const PAIRS = [...STAR_PAIRS, "planes"] as const;
const SIDES = ["a", "b"] as const;
export const WALKS = ["paper-corrected", "paper"] as const;
export const LESSON_SAMPLERS = [...WALKS, "mala", "hmc", "independence"] as const;
export const BREAKS = ["none", "scaling", "one-chain", "sigma", "misaligned"] as const;

const coefficients = (standard: readonly number[]) => list(standard, -6, 6);

/** Parameters of the scenes with their defaults; `shapevenn lesson` has the same. */
export const SCENE_PARAMS = {
  model: {
    pair: choice("stars-5", STAR_PAIRS),
    side: choice("a", SIDES),
    coefficients: coefficients([1.2, -0.6]),
  },
  agree: {
    pair: choice("stars-5", STAR_PAIRS),
    sigma: number(0.003, 0.0001, 3, 5),
    guess: list([], 0, 4, 0),
    shown: flag(),
  },
  planes: {
    tilt: number(50, 0, 90, 0),
    shift: number(0.4, -2, 2, 2),
    lift: number(0, -1.5, 1.5, 2),
    sigma: number(0.3, 0.01, 3),
    side: choice("a", SIDES),
    coefficients: coefficients([0.8, 0.8]),
    turn: list([-0.6, 0.36], -7, 7),
  },
  step: {
    pair: choice("planes", PAIRS),
    sigma: number(0.3, 0.001, 3),
    side: choice("a", SIDES),
    sampler: choice("paper-corrected", WALKS),
    chains: count(1, 1, 16),
    seed: seed(),
    steps: count(0, 0, 20_000),
    /** Steps per second: changes the animation, not the result. */
    speed: number(0.8, 0.5, 1000, 2),
  },
  cloud: {
    pair: choice("stars-5", STAR_PAIRS),
    sigma: number(0.003, 0.0001, 3, 5),
    sampler: choice("independence", LESSON_SAMPLERS),
    chains: count(8, 1, 16),
    seed: seed(),
    draws: count(2000, 16, 20_000),
  },
  difference: {
    pair: choice("planes", PAIRS),
    sigma: number(0.3, 0.001, 3),
    side: choice("a", SIDES),
    seed: seed(),
    draws: count(1000, 16, 5000),
    flipped: flag(),
  },
  race: {
    pair: choice("stars-5", PAIRS),
    sigma: number(0.003, 0.0001, 3, 5),
    side: choice("a", SIDES),
    chains: count(4, 1, 16),
    seed: seed(),
    steps: count(500, 16, 5000),
    break: choice("none", BREAKS),
  },
  yours: {},
  teacher: {},
} as const satisfies Record<string, Schema>;

export type SceneName = keyof typeof SCENE_PARAMS;
export type SceneValues<N extends SceneName> = Values<(typeof SCENE_PARAMS)[N]>;

export interface SceneTitle {
  name: SceneName;
  /** Title in the list of scenes. */
  short: string;
  title: string;
}

/** The scenes in their order; the page for teachers follows them. */
export const SCENES: readonly SceneTitle[] = [
  { name: "model", short: "One model", title: "What a shape model is" },
  { name: "agree", short: "Two models", title: "Two models: where do they agree?" },
  { name: "planes", short: "Two planes", title: "Two planes in space" },
  { name: "step", short: "One step", title: "One Metropolis–Hastings step at a time" },
  { name: "cloud", short: "The cloud", title: "From cloud to model" },
  { name: "difference", short: "The difference", title: "The difference: flip the likelihood" },
  { name: "race", short: "The race", title: "Better samplers, and how to break them" },
  { name: "yours", short: "Your turn", title: "Now with faces, and with yours" },
];
export const TEACHER: SceneTitle = {
  name: "teacher",
  short: "For teachers",
  title: "For teachers",
};

export function titleOf(name: SceneName): SceneTitle {
  return SCENES.find((scene) => scene.name === name) ?? TEACHER;
}
