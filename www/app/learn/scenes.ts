/** The scenes of the lessons, in their order, with the schema of their parameters. */
import { SCENE_BOUNDS } from "../state/settings";
import { choice, flag, list, number, type Schema, seed, type Values } from "./params";

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

/** The bounds of a number of a scene, which are the engine's (src/lessons/scene.rs). */
function boundsOf(scene: string, key: string) {
  const found = SCENE_BOUNDS.find((bounds) => bounds.scene === scene && bounds.key === key);
  if (!found) throw new Error(`The engine has no bounds of ${key} in the scene ${scene}.`);
  return found;
}

const within = (scene: string, key: string, standard: number) => {
  const { least, most, digits } = boundsOf(scene, key);
  return number(standard, least, most, digits);
};

const coefficients = (scene: string, standard: readonly number[]) => {
  const { least, most, digits } = boundsOf(scene, "coefficients");
  return list(standard, least, most, digits);
};

/** Parameters of the scenes with their defaults; `shapevenn lesson` has the same. */
export const SCENE_PARAMS = {
  model: {
    pair: choice("stars-5", STAR_PAIRS),
    side: choice("a", SIDES),
    coefficients: coefficients("model", [1.2, -0.6]),
  },
  agree: {
    pair: choice("stars-5", STAR_PAIRS),
    sigma: within("agree", "sigma", 0.003),
    guess: list([], 0, 4, 0),
    shown: flag(),
  },
  planes: {
    tilt: within("planes", "tilt", 50),
    shift: within("planes", "shift", 0.4),
    lift: within("planes", "lift", 0),
    sigma: within("planes", "sigma", 0.3),
    side: choice("a", SIDES),
    coefficients: coefficients("planes", [0.8, 0.8]),
    turn: list([-0.6, 0.36], -7, 7),
  },
  step: {
    pair: choice("planes", PAIRS),
    sigma: within("step", "sigma", 0.3),
    side: choice("a", SIDES),
    sampler: choice("paper-corrected", WALKS),
    chains: within("step", "chains", 1),
    seed: seed(),
    steps: within("step", "steps", 0),
    /** Steps per second: changes the animation, not the result. */
    speed: number(0.8, 0.5, 1000, 2),
  },
  cloud: {
    pair: choice("stars-5", STAR_PAIRS),
    sigma: within("cloud", "sigma", 0.003),
    sampler: choice("independence", LESSON_SAMPLERS),
    chains: within("cloud", "chains", 8),
    seed: seed(),
    draws: within("cloud", "draws", 2000),
  },
  difference: {
    pair: choice("planes", PAIRS),
    sigma: within("difference", "sigma", 0.3),
    side: choice("a", SIDES),
    seed: seed(),
    draws: within("difference", "draws", 1000),
    flipped: flag(),
  },
  race: {
    pair: choice("stars-5", PAIRS),
    sigma: within("race", "sigma", 0.003),
    side: choice("a", SIDES),
    chains: within("race", "chains", 4),
    seed: seed(),
    steps: within("race", "steps", 500),
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
