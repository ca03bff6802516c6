/** Hook that sends a question to the engine and returns its latest answer. */
import { useSignal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";
import { EngineFailure, wasAborted } from "../../worker/engine-errors";
import { latest } from "./latest";

export interface Answer<Q, A> {
  /** The question. */
  question: Q;
  answer: A | null;
  /** The error, if there is no answer. */
  problem: { message: string; hint: string } | null;
}

/**
 * Returns the latest answer. A new question, compared by its fields, is sent when the one before is answered;
 * null sends nothing and keeps the last answer.
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
          // Answers from before a restart of the engine are still valid.
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
