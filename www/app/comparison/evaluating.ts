/** Asks the engine for generalization and specificity of a model, as Davies defines them, with given shapes. */
import { type Signal, signal } from "@preact/signals";
import { EngineFailure, sentenceOf } from "../../worker/engine-errors";
import type { DroppedFile, Evaluation, Placement, Side } from "../../worker/protocol";
import { engineClient } from "../state/engine";
import { slotKey, slots, spoken } from "../state/state";
import { evaluationSentence } from "./measured";

export interface Evaluated {
  /** Key of the model. */
  key: string;
  unit: string;
  evaluation: Evaluation | null;
  problem: { message: string; hint: string } | null;
}

export const evaluated: Record<Side, Signal<Evaluated | null>> = {
  a: signal(null),
  b: signal(null),
};
/** How test shapes are placed before they are projected. */
export const placement = signal<Placement>("fit");
export const evaluating: Record<Side, Signal<boolean>> = { a: signal(false), b: signal(false) };

/** The training shapes of a model, where the page still has them. */
export function trainingFiles(side: Side): DroppedFile[] | null {
  const slot = slots[side].value;
  if (slot?.origin.kind !== "shapes" || slot.source.kind !== "files") return null;
  // If an archive holds several sets of shapes, the files of one set are not known.
  return slot.parts.length === 1 ? slot.source.files : null;
}

export async function evaluate(side: Side, files: DroppedFile[], training: boolean): Promise<void> {
  const slot = slots[side].value;
  if (!slot || files.length === 0 || evaluating[side].value) return;
  const about = { key: slotKey(slot), unit: slot.report.unit };
  const name = side.toUpperCase();
  evaluating[side].value = true;
  spoken.value = `Testing model ${name}.`;
  try {
    const { signal: kept } = new AbortController();
    const evaluation = await engineClient().evaluate(
      kept,
      slot.model,
      files,
      training,
      placement.value,
    );
    evaluated[side].value = { ...about, evaluation, problem: null };
    spoken.value = evaluationSentence(evaluation, name, about.unit);
  } catch (thrown) {
    const problem =
      thrown instanceof EngineFailure ? thrown : { message: sentenceOf(thrown), hint: "" };
    evaluated[side].value = { ...about, evaluation: null, problem };
    spoken.value = `${problem.message} ${problem.hint}`;
  } finally {
    evaluating[side].value = false;
  }
}
