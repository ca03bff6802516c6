/** Keys for presenting lessons; a remote control sends Page Up and Page Down. */
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { neighbours } from "./parts/SceneList";
import { goTo, large, resetScene, scene, settle } from "./state";

/** Actions of the present scene for the keys Space and S. */
export const runKey = signal<(() => void) | null>(null);
export const stepKey = signal<(() => void) | null>(null);

export const PRESENTER_KEYS: readonly (readonly [string, string])[] = [
  ["→  Page Down", "next scene"],
  ["←  Page Up", "previous scene"],
  ["Space", "run or pause"],
  ["S", "one step"],
  ["R", "reset the scene"],
  ["P", "large letters for a projector"],
  ["F", "full screen"],
];

export function useKeys(): void {
  useEffect(() => {
    addEventListener("keydown", press);
    return () => removeEventListener("keydown", press);
  }, []);
}

/** Elements in which letters, or arrow keys and Space, have their own meaning. */
const TYPED = "input[type=text], select, textarea, dialog";
const OWN = "input, button, summary, [role=application], [role=slider]";

function press(event: KeyboardEvent): void {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const { target } = event;
  const isIn = (kind: string) => target instanceof Element && target.closest(kind) !== null;
  if (isIn(TYPED)) return;
  const isTurn = event.key === "PageDown" || event.key === "PageUp";
  if (isIn(OWN) && !isTurn && !/^[srpf]$/i.test(event.key)) return;
  const act = actionOf(event.key);
  if (!act) return;
  event.preventDefault();
  act();
}

function actionOf(key: string): (() => void) | null {
  const { before, after } = neighbours(scene.peek());
  switch (key.length === 1 ? key.toLowerCase() : key) {
    case "ArrowRight":
    case "PageDown":
      return after && (() => goTo(after));
    case "ArrowLeft":
    case "PageUp":
      return before && (() => goTo(before));
    case " ":
      return runKey.peek();
    case "s":
      return stepKey.peek();
    case "r":
      return resetScene;
    case "p":
      return toggleLarge;
    case "f":
      return toggleFullScreen;
    default:
      return null;
  }
}

export function toggleLarge(): void {
  large.value = !large.value;
  settle();
}

export function toggleFullScreen(): void {
  // A frame may not allow it: then nothing happens.
  if (document.fullscreenElement) void document.exitFullscreen().catch(() => undefined);
  else void document.documentElement.requestFullscreen?.().catch(() => undefined);
}

/** Sets the actions for the keys Space and S while a scene is shown. */
export function useSceneKeys(run: (() => void) | null, step: (() => void) | null): void {
  useEffect(() => {
    runKey.value = run;
    stepKey.value = step;
    return () => {
      runKey.value = null;
      stepKey.value = null;
    };
  });
}
