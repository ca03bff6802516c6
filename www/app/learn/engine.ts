/** Sends questions of the lessons to the engine, one at a time for each scene. */
import { wasAborted } from "../../worker/engine-errors";
import type { LessonAnswers, LessonAsk } from "../../worker/protocol";
import { engineClient, onEngineRestart, report } from "../state/engine";
import { lessonState, resets } from "./state";

export type Ask = <K extends LessonAsk["ask"]>(
  question: Extract<LessonAsk, { ask: K }>,
) => Promise<LessonAnswers[K]>;

/** Returns a function with which a scene asks until `signal` aborts. */
export function asker(signal: AbortSignal): Ask {
  const client = engineClient();
  return (question) => client.lesson(signal, question);
}

/** Shows an error of a scene; leaving a scene is no error. */
export function sceneFailed(thrown: unknown): void {
  if (wasAborted(thrown)) return;
  lessonState.value = "error";
  report("page", thrown);
}

// A restarted engine has no open lesson: the scene starts again.
onEngineRestart(() => {
  resets.value += 1;
});
