/** Writes and reads the part of a link that holds a scene: `page=learn&scene=step&seed=7&steps=120`. Pure. */
import { readValues, type Schema, standardValues, writeValues } from "./params";
import { SCENE_PARAMS, SCENES, type SceneName, type SceneValues } from "./scenes";

export interface LessonState {
  scene: SceneName;
  values: SceneValues<SceneName>;
  /** Whether letters are large, for a lecture hall. */
  large: boolean;
}

export const FIRST_SCENE: SceneName = SCENES[0]?.name ?? "model";

export function defaultLesson(): LessonState {
  return {
    scene: FIRST_SCENE,
    values: standardValues(SCENE_PARAMS[FIRST_SCENE]),
    large: false,
  };
}

export function readLesson(given: URLSearchParams): LessonState {
  const asked = given.get("scene") ?? "";
  const scene = Object.hasOwn(SCENE_PARAMS, asked) ? (asked as SceneName) : FIRST_SCENE;
  return {
    scene,
    values: readValues(SCENE_PARAMS[scene], given),
    large: given.get("size") === "large",
  };
}

export function writeLesson({ scene, values, large }: LessonState): [string, string][] {
  const schema: Schema = SCENE_PARAMS[scene];
  const pairs: [string, string][] = [["scene", scene], ...writeValues(schema, values)];
  return large ? [...pairs, ["size", "large"]] : pairs;
}
