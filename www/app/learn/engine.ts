/** Lessons ask the engine: one question at a time for each scene, of the lesson that the scene opened. */
import { wasAborted } from "../../worker/engine-errors";
import type { LessonAnswers, LessonAsk } from "../../worker/lessons";
import { engineClient, onEngineRestart, report } from "../state/engine";
import { lessonState, resets } from "./state";

export type Ask = <K extends LessonAsk["ask"]>(
  question: Extract<LessonAsk, { ask: K }>,
) => Promise<LessonAnswers[K]>;

/** How a scene asks, until `signal` says that it is over. */
export function asker(signal: AbortSignal): Ask {
  const client = engineClient();
  return (question) => client.lesson(signal, question);
}

/** What goes wrong in a scene is said; that it was left is nothing wrong. */
export function sceneFailed(thrown: unknown): void {
  if (wasAborted(thrown)) return;
  lessonState.value = "error";
  report("page", thrown);
}

// A new engine knows nothing of the lesson: scenes begin anew.
onEngineRestart(() => {
  resets.value += 1;
});
