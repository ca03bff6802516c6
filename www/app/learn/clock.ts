/** Runs animations frame by frame, stops them when hidden, and respects reduced motion. */
import { type Signal, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";

const calm = matchMedia("(prefers-reduced-motion: reduce)");
/** Whether the system asks for reduced motion. */
export const still = signal(calm.matches);
calm.addEventListener("change", () => {
  still.value = calm.matches;
});

/** Largest step of time: after the page was hidden the motion continues without a jump. */
const LONGEST_FRAME_MS = 100;

/** Calls `frame` with the milliseconds since the last one, while `playing` is on. */
export function useFrames(playing: Signal<boolean>, frame: (elapsed: number) => void): void {
  const latest = useRef(frame);
  latest.current = frame;
  const on = playing.value;
  useEffect(() => {
    if (!on) return;
    let before = performance.now();
    let handle = requestAnimationFrame(function next(now) {
      const elapsed = Math.min(LONGEST_FRAME_MS, Math.max(0, now - before));
      before = now;
      // It may have been stopped since the last frame.
      if (playing.peek()) latest.current(elapsed);
      handle = requestAnimationFrame(next);
    });
    return () => cancelAnimationFrame(handle);
  }, [on, playing]);
}
