/** Tracks whether a pointer is pressed, as on a point or a slider. */
import { useEffect } from "preact/hooks";
import { hold } from "./state";

const take = () => hold(true);
const free = () => hold(false);

export function useHands(): void {
  useEffect(() => {
    const ends = new AbortController();
    const { signal } = ends;
    addEventListener("pointerdown", take, { capture: true, signal });
    addEventListener("pointerup", free, { capture: true, signal });
    addEventListener("pointercancel", free, { capture: true, signal });
    // Only for the window: elements inside also lose the focus when another one is pressed.
    addEventListener("blur", free, { signal });
    return () => {
      ends.abort();
      free();
    };
  }, []);
}
