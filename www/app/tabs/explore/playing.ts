/** Animates a slider of the explorer from end to end and back, or all of them in turn. */
import { effect, signal } from "@preact/signals";
import { REACH_SD } from "../../state/explorer";
import { coefficients, currentAxes, explorer, setCoefficient, settle } from "../../state/exploring";
import { tab } from "../../state/state";

/** Milliseconds from the middle to one end, to the other, and back. */
const PERIOD_MS = 4000;

export interface Playing {
  axis: number;
  /** Whether the next slider follows. */
  all: boolean;
}
export const playing = signal<Playing | null>(null);

let frame = 0;
let begun = 0;
/** Value of the slider before the animation. */
let before = 0;

/** Coefficient of an animated slider after some time, in standard deviations; it begins at `from`. */
export function swing(from: number, milliseconds: number): number {
  const start = Math.asin(Math.max(-1, Math.min(1, from / REACH_SD)));
  return REACH_SD * Math.sin(start + (2 * Math.PI * milliseconds) / PERIOD_MS);
}

export function play(axis: number, all: boolean): void {
  stopPlaying();
  begin(axis, all);
  frame = requestAnimationFrame(next);
}

/** Stops the animation; the slider keeps its value. */
export function stopPlaying(): void {
  if (playing.peek() === null) return;
  cancelAnimationFrame(frame);
  playing.value = null;
  settle();
}

function begin(axis: number, all: boolean): void {
  playing.value = { axis, all };
  before = coefficients.peek()[axis] ?? 0;
  begun = performance.now();
}

function next(now: number): void {
  const found = playing.peek();
  const count = currentAxes.peek()?.values.length ?? 0;
  if (!found || found.axis >= count) {
    stopPlaying();
    return;
  }
  const elapsed = Math.max(0, now - begun);
  if (found.all && elapsed >= PERIOD_MS) {
    setCoefficient(found.axis, before);
    begin((found.axis + 1) % count, true);
  } else {
    setCoefficient(found.axis, swing(before, elapsed));
  }
  frame = requestAnimationFrame(next);
}

/** Stops the animation when the explorer is hidden or the system asks for reduced motion. */
export function watchPlaying(): void {
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  calm.addEventListener("change", () => {
    if (calm.matches) stopPlaying();
  });
  let driven = "";
  effect(() => {
    const { space, kind } = explorer.value;
    const now = `${tab.value} ${space} ${kind}`;
    if (now !== driven) stopPlaying();
    driven = now;
  });
}
