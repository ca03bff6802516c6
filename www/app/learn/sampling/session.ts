/** A lesson that a scene has open, begun anew whenever what it is of changes. */
import { useLayoutEffect, useRef } from "preact/hooks";
import { type Ask, asker, sceneFailed } from "../engine";
import { lessonState } from "../state";

/** While a slider is on its way, a lesson for every place on it is more than anybody sees. */
const SETTLE_MS = 60;

/** Opens a lesson for `key`, and gives up what an earlier one still asks for. */
export function useSession(key: string, open: (ask: Ask) => Promise<void>): void {
  const latest = useRef(open);
  latest.current = open;
  const isFirst = useRef(true);
  // Before anybody looks: what is shown from now on is not yet of this key.
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

/** Nothing goes on with an answer that came after its lesson was given up. */
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
 * A value that a scene writes down itself, such as the step at which it was paused. Where a link or Back
 * changes it, `revision` goes up.
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

/** Work that is done one piece at a time; what comes while some is done is not taken on. */
export class Turns {
  #last: Promise<void> = Promise.resolve();
  #busy = false;

  get busy(): boolean {
    return this.#busy;
  }

  /** Begins `work`, unless there is some. */
  take(work: () => Promise<void>): void {
    if (this.#busy) return;
    this.#busy = true;
    this.#last = work()
      .catch(sceneFailed)
      .finally(() => {
        this.#busy = false;
      });
  }

  /** Resolves when nothing is done any more. */
  idle(): Promise<void> {
    return this.#last;
  }
}
