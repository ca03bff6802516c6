/** Which scene is on, and what is chosen in each. */
import { batch, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import type { LessonState } from "./link";
import { defaultLesson } from "./link";
import { standardValues } from "./params";
import { SCENE_PARAMS, type SceneName, type SceneValues } from "./scenes";

const first = defaultLesson();

/** As `document.documentElement.dataset.state`: whether the scene has what it shows. */
export const lessonState = signal<"loading" | "done" | "error">("loading");
export const scene = signal<SceneName>(first.scene);
/** Letters as large as a lecture hall needs them. */
export const large = signal(false);

type Live = { [N in SceneName]: Signal<SceneValues<N>> };

/** What is chosen in each scene, under the hand of whoever moves it. */
const live = Object.fromEntries(
  Object.entries(SCENE_PARAMS).map(([name, schema]) => [name, signal(standardValues(schema))]),
) as unknown as Live;

/** As it is in the link, and a step that Back undoes: once nothing moves any more. */
const settled = signal<LessonState>(first);
export const settledLesson: ReadonlySignal<LessonState> = settled;

const SETTLE_MS = 400;
let timer: ReturnType<typeof setTimeout> | undefined;
/** Something was changed and not written down yet. */
let pending = false;
let held = false;

/** What is chosen in a scene. */
export function params<N extends SceneName>(name: N): ReadonlySignal<SceneValues<N>> {
  return live[name] as unknown as ReadonlySignal<SceneValues<N>>;
}

/** Changes some of it; while it goes on changing nothing is written down. */
export function setParams<N extends SceneName>(name: N, part: Partial<SceneValues<N>>): void {
  const values = live[name] as unknown as Signal<SceneValues<N>>;
  values.value = { ...values.peek(), ...part };
  pending = true;
  wait();
}

/** While something is held nothing is written down: a drag is one step of Back, however slow. */
export function hold(now: boolean): void {
  held = now;
  if (pending) wait();
}

function wait(): void {
  clearTimeout(timer);
  if (!held) timer = setTimeout(settle, SETTLE_MS);
}

/** Writes down what is chosen now. */
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

/** The scene as it is at first. */
export function resetScene(): void {
  const name = scene.peek();
  batch(() => {
    (live[name] as Signal<unknown>).value = standardValues(SCENE_PARAMS[name]);
    settle();
    resets.value += 1;
  });
}

/** Scenes begin anew when this goes up, though nothing that is chosen may have changed. */
export const resets = signal(0);

/** As a link or a step of Back has it. */
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
