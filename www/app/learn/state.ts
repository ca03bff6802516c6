/** State of the lessons: the shown scene and the parameters of each scene. */
import { batch, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import type { LessonState } from "./link";
import { defaultLesson } from "./link";
import { standardValues } from "./params";
import { SCENE_PARAMS, type SceneName, type SceneValues } from "./scenes";

const first = defaultLesson();

/** State of the scene, as in `document.documentElement.dataset.state`. */
export const lessonState = signal<"loading" | "done" | "error">("loading");
export const scene = signal<SceneName>(first.scene);
/** Whether letters are large, for a lecture hall. */
export const large = signal(false);

type Live = { [N in SceneName]: Signal<SceneValues<N>> };

/** Parameters of each scene as they are shown, changed with every movement. */
const live = Object.fromEntries(
  Object.entries(SCENE_PARAMS).map(([name, schema]) => [name, signal(standardValues(schema))]),
) as unknown as Live;

/** Parameters that are in the link and a step of undo: written when a movement ends. */
const settled = signal<LessonState>(first);
export const settledLesson: ReadonlySignal<LessonState> = settled;

const SETTLE_MS = 400;
let timer: ReturnType<typeof setTimeout> | undefined;
/** Whether there are changes that are not written yet. */
let pending = false;
let held = false;

/** The parameters of a scene. */
export function params<N extends SceneName>(name: N): ReadonlySignal<SceneValues<N>> {
  return live[name] as unknown as ReadonlySignal<SceneValues<N>>;
}

/** Changes parameters; they are written to the link after the last change. */
export function setParams<N extends SceneName>(name: N, part: Partial<SceneValues<N>>): void {
  const values = live[name] as unknown as Signal<SceneValues<N>>;
  values.value = { ...values.peek(), ...part };
  pending = true;
  wait();
}

/** Waits until no pointer is pressed: a drag is one step of undo, however slow. */
export function hold(now: boolean): void {
  held = now;
  if (pending) wait();
}

function wait(): void {
  clearTimeout(timer);
  if (!held) timer = setTimeout(settle, SETTLE_MS);
}

/** Writes the present parameters to the link. */
export function settle(): void {
  clearTimeout(timer);
  pending = false;
  settled.value = {
    scene: scene.peek(),
    values: live[scene.peek()].peek(),
    large: large.peek(),
  };
}

export function goTo(name: SceneName): void {
  batch(() => {
    scene.value = name;
    settle();
  });
}

/** Resets the scene to its defaults. */
export function resetScene(): void {
  const name = scene.peek();
  batch(() => {
    (live[name] as Signal<unknown>).value = standardValues(SCENE_PARAMS[name]);
    settle();
    resets.value += 1;
  });
}

/** Counter that restarts the scenes when it increases, even without a change of parameters. */
export const resets = signal(0);

/** Sets scene and parameters from a link or a step of Back. */
export function applyLesson(lesson: LessonState): void {
  clearTimeout(timer);
  pending = false;
  batch(() => {
    scene.value = lesson.scene;
    large.value = lesson.large;
    (live[lesson.scene] as Signal<unknown>).value = lesson.values;
    settled.value = lesson;
  });
}
