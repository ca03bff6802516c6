/** Waits until the first picture is drawn, so that nothing heavy is downloaded or started before it. */
import { drawable } from "../stage/stage-controller";

/** A picture that has not come by then is not waited for. */
const LONGEST_MS = 5000;
/** What somebody does who wants more than to look. */
const BEGINNINGS = ["pointerdown", "keydown", "dragenter", "hashchange"];

/** Resolves when the picture is drawn and the browser has time, or as soon as somebody begins to use the page. */
export async function untilPictured(): Promise<void> {
  const over = new AbortController();
  await new Promise<void>((resolve) => {
    const timer = setTimeout(resolve, LONGEST_MS);
    for (const name of BEGINNINGS) {
      addEventListener(name, () => resolve(), { capture: true, signal: over.signal });
    }
    const stop = drawable.subscribe((drawn) => {
      // The next frame draws it, and it is seen in the one after.
      if (drawn) requestAnimationFrame(() => requestAnimationFrame(() => whenIdle(resolve)));
    });
    over.signal.addEventListener("abort", () => {
      clearTimeout(timer);
      stop();
    });
  });
  over.abort();
}

/** Safari has no idle callbacks. */
function whenIdle(work: () => void): void {
  if ("requestIdleCallback" in globalThis) requestIdleCallback(work);
  else setTimeout(work);
}
