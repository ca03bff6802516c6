/** What a scene asks of the engine, as a part of what it shows: asked anew whenever the question changes. */
import { useSignal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";
import type { LessonAnswers, LessonAsk } from "../../worker/lessons";
import { latest } from "../state/latest";
import { type Ask, asker, sceneFailed } from "./engine";
import { lessonState } from "./state";

/** Asks for as long as the scene is shown. */
export function useAsk(): Ask {
  const [ask, controller] = useMemo(() => {
    const own = new AbortController();
    return [asker(own.signal), own] as const;
  }, []);
  useEffect(() => () => controller.abort(), [controller]);
  return ask;
}

export interface Asked<T> {
  /** Of the question, or of the last one that was answered: so that a picture moves along. */
  answer: T | null;
  /** Whether the answer is that of the present question. */
  current: boolean;
}

/**
 * The answer to one question. `of` is what it depends on besides: an opened lesson, say. Nothing is asked
 * while the question is null.
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

/** Says to the document whether the scene has what it shows. */
export function useDone(done: boolean): void {
  useEffect(() => {
    // What went wrong is said until something is right again.
    if (done || lessonState.peek() !== "error") lessonState.value = done ? "done" : "loading";
  }, [done]);
  useEffect(
    () => () => {
      lessonState.value = "loading";
    },
    [],
  );
}
