/** Hook that opens a lesson for a scene, again whenever its key changes. */
import { useLayoutEffect, useRef } from "preact/hooks";
import { type Ask, asker, sceneFailed } from "../engine";
import { lessonState } from "../state";

/** Milliseconds without a change after which a lesson is opened: not for every position of a moving slider. */
const SETTLE_MS = 60;

/** Opens a lesson for `key`, and aborts the requests of an earlier one. */
export function useSession(key: string, open: (ask: Ask) => Promise<void>): void {
  const latest = useRef(open);
  latest.current = open;
  const isFirst = useRef(true);
  // In a layout effect: from now on the picture is not yet of this key.
  useLayoutEffect(() => {
    const control = new AbortController();
    lessonState.value = "loading";
    const begin = () => latest.current(guarded(control.signal)).catch(sceneFailed);
    const timer = setTimeout(begin, isFirst.current ? 0 : SETTLE_MS);
    isFirst.current = false;
    return () => {
      clearTimeout(timer);
      control.abort();
    };
  }, [key]);
}

/** Wraps `ask` so that answers after an abort are rejected. */
function guarded(signal: AbortSignal): Ask {
  const ask = asker(signal);
  return async (question) => {
    signal.throwIfAborted();
    const answer = await ask(question);
    signal.throwIfAborted();
    return answer;
  };
}

/**
 * Tracks a parameter that the scene itself writes, such as the step at which it was paused: `revision` increases only
 * if a link or Back changes it.
 */
export function useOwn(value: number): { revision: number; own: (written: number) => void } {
  const written = useRef(value);
  const revision = useRef(0);
  if (written.current !== value) {
    written.current = value;
    revision.current += 1;
  }
  return {
    revision: revision.current,
    own: (next) => {
      written.current = next;
    },
  };
}

/** Runs one asynchronous task at a time; tasks that come meanwhile are dropped. */
export class Turns {
  #last: Promise<void> = Promise.resolve();
  #busy = false;

  get busy(): boolean {
    return this.#busy;
  }

  /** Starts `work`, unless a task is running. */
  take(work: () => Promise<void>): void {
    if (this.#busy) return;
    this.#busy = true;
    this.#last = work()
      .catch(sceneFailed)
      .finally(() => {
        this.#busy = false;
      });
  }

  /** Resolves when no task is running. */
  idle(): Promise<void> {
    return this.#last;
  }
}
