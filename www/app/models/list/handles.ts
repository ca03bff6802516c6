/**
 * Closes models in the engine that are no longer used: neither as A or B, nor in the model list, nor while being
 * opened.
 */
import type { Handle } from "../../../worker/protocol";
import { engineClient } from "../../state/engine";
import { modelList, slots } from "../../state/state";

const open = new Set<Handle>();
/** Models that are being opened, with the number of their users. */
const retained = new Map<Handle, number>();

/** Keeps a model open until it is released. */
export function retain(model: Handle): void {
  open.add(model);
  retained.set(model, (retained.get(model) ?? 0) + 1);
}

/** Releases a model that was kept open. */
export function release(models: readonly Handle[]): void {
  for (const model of models) {
    const left = (retained.get(model) ?? 0) - 1;
    if (left > 0) retained.set(model, left);
    else retained.delete(model);
  }
  closeUnused();
}

export function closeUnused(): void {
  const used = new Set(
    [slots.a.peek(), slots.b.peek(), ...modelList.peek()].map((slot) => slot?.model),
  );
  for (const model of [...open]) {
    if (used.has(model) || retained.has(model)) continue;
    open.delete(model);
    engineClient().close(model);
  }
}

/** Forgets all handles: a new worker has no models. */
export function forgetHandles(): void {
  open.clear();
  retained.clear();
}
