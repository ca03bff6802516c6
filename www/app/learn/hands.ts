/** Whether a hand is on something: a point, a slider. */
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
    // Of the window alone: what is inside loses the focus when a hand is put on something else.
    addEventListener("blur", free, { signal });
    return () => {
      ends.abort();
      free();
    };
  }, []);
}
