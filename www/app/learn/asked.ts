/** Hooks with which a scene asks the engine: a question is sent again whenever it changes. */
import { useSignal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";
import type { LessonAnswers, LessonAsk } from "../../worker/protocol";
import { latest } from "../state/latest";
import { type Ask, asker, sceneFailed } from "./engine";
import { lessonState } from "./state";

/** Returns a function that asks the engine while the scene is shown. */
export function useAsk(): Ask {
  const [ask, controller] = useMemo(() => {
    const own = new AbortController();
    return [asker(own.signal), own] as const;
  }, []);
  useEffect(() => () => controller.abort(), [controller]);
  return ask;
}

export interface Asked<T> {
  /** Answer to the question, or to the last answered one, so that the picture keeps moving. */
  answer: T | null;
  /** Whether the answer is to the present question. */
  current: boolean;
}

/**
 * Returns the answer to one question. `of` is what else it depends on, such as an opened lesson. Nothing is sent while
 * the question is null.
 */
export function useAsked<K extends LessonAsk["ask"]>(
  ask: Ask,
  question: Extract<LessonAsk, { ask: K }> | null,
  of: unknown = null,
): Asked<LessonAnswers[K]> {
  const text = question && JSON.stringify(question);
  const found = useSignal<{ text: string; of: unknown; answer: LessonAnswers[K] } | null>(null);
  const put = useMemo(
    () =>
      latest(async (asked: { text: string; of: unknown }) => {
        try {
          const answer = await ask<K>(JSON.parse(asked.text));
          found.value = { ...asked, answer };
        } catch (thrown) {
          sceneFailed(thrown);
        }
      }),
    [ask, found],
  );
  useEffect(() => {
    if (text !== null) put({ text, of });
  }, [text, of, put]);
  const { value } = found;
  return {
    answer: value?.answer ?? null,
    current: value !== null && value.text === text && value.of === of,
  };
}

/** Sets the state of the document: whether the scene is complete. */
export function useDone(done: boolean): void {
  useEffect(() => {
    // An error stays until the next answer.
    if (done || lessonState.peek() !== "error") lessonState.value = done ? "done" : "loading";
  }, [done]);
  useEffect(
    () => () => {
      lessonState.value = "loading";
    },
    [],
  );
}
