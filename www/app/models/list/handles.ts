/** Closes models in the engine that nothing refers to any more: neither A, B, the model list nor who opens them. */
import type { Handle } from "../../../worker/protocol";
import { engineClient } from "../../state/engine";
import { modelList, slots } from "../../state/state";

const open = new Set<Handle>();
/** Models on their way to a place, each as often as somebody carries it. */
const carried = new Map<Handle, number>();

/** Nobody closes this model until it is put down. */
export function carry(model: Handle): void {
  open.add(model);
  carried.set(model, (carried.get(model) ?? 0) + 1);
}

/** It has found its place, or nobody wanted it after all. */
export function putDown(models: readonly Handle[]): void {
  for (const model of models) {
    const left = (carried.get(model) ?? 0) - 1;
    if (left > 0) carried.set(model, left);
    else carried.delete(model);
  }
  closeUnused();
}

export function closeUnused(): void {
  const used = new Set(
    [slots.a.peek(), slots.b.peek(), ...modelList.peek()].map((slot) => slot?.model),
  );
  for (const model of [...open]) {
    if (used.has(model) || carried.has(model)) continue;
    open.delete(model);
    engineClient().close(model);
  }
}

/** With its worker went every model. */
export function forgetHandles(): void {
  open.clear();
  carried.clear();
}
