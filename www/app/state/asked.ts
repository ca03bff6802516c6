/** Requests to the engine whose latest answer is shown. */
import { useSignal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";
import { EngineFailure, wasAborted } from "../../worker/engine-errors";
import { latest } from "./latest";

export interface Answer<Q, A> {
  /** What was asked. */
  question: Q;
  answer: A | null;
  /** Why there is none. */
  problem: { message: string; hint: string } | null;
}

/**
 * The latest answer. A new question, by its fields, is asked as soon as the engine has answered the one before;
 * null asks nothing and leaves what is there.
 */
export function useAnswer<Q extends object, A>(
  question: Q | null,
  ask: (signal: AbortSignal, question: Q) => Promise<A>,
): { shown: Answer<Q, A> | null; current: boolean } {
  const shown = useSignal<Answer<Q, A> | null>(null);
  const controller = useMemo(() => new AbortController(), []);
  const put = useMemo(
    () =>
      latest(async (asked: Q) => {
        try {
          const answer = await ask(controller.signal, asked);
          shown.value = { question: asked, answer, problem: null };
        } catch (thrown) {
          if (wasAborted(thrown) || !(thrown instanceof EngineFailure)) return;
          // After a restart of the engine what it said before still holds.
          if (thrown.code === "engine-stopped") return;
          shown.value = { question: asked, answer: null, problem: thrown };
        }
      }),
    [],
  );
  const fields = question === null ? [] : Object.values(question);
  useEffect(() => {
    if (question !== null) put(question);
  }, [question === null, ...fields]);
  useEffect(() => () => controller.abort(), []);
  const answered = shown.value && Object.values(shown.value.question);
  const current = question !== null && fields.every((value, i) => value === answered?.[i]);
  return { shown: shown.value, current };
}
