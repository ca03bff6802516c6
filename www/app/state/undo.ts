/** The steps of undo, and changes that are joined to a step instead of making one. */
import { batch } from "@preact/signals";
import type { PointSelection, Side } from "../../worker/protocol";
import type { Wanted } from "./state";
import { Steps } from "./steps";

/** State of a step that no address can hold: files, and long lists of points. */
export interface Snapshot {
  models: Record<Side, Wanted> | null;
  modelList: Wanted[];
  points: PointSelection | null;
}

export const steps = new Steps<Snapshot>(history, performance.timeOrigin);

/** Whether present changes belong to the step before. */
let joining = false;

export function joins(): boolean {
  return joining;
}

/** Makes a change as part of the step `of`, if that is still the last one. */
export function joinStep(change: () => void, of: number): void {
  joining = steps.at === of;
  try {
    batch(change);
  } finally {
    joining = false;
  }
}

/** Joins all changes until the promise is resolved to the present step. */
export async function joinUntil(over: Promise<void>): Promise<void> {
  joining = true;
  try {
    await over;
  } finally {
    joining = false;
  }
}

/** The number of the present step. */
export function currentStep(): number {
  return steps.at;
}
