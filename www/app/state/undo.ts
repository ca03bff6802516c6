/** The steps that can be undone, and what joins one of them instead of being a step of its own. */
import { batch } from "@preact/signals";
import type { PointSelection } from "../../worker/protocol";
import type { Side, Wanted } from "./state";
import { Steps } from "./steps";

/** What a step of the history holds that no address can: files, and long lists of points. */
export interface Snapshot {
  models: Record<Side, Wanted> | null;
  modelList: Wanted[];
  points: PointSelection | null;
}

export const steps = new Steps<Snapshot>(history, performance.timeOrigin);

/** What changes just now belongs to the step before. */
let joining = false;

export function joins(): boolean {
  return joining;
}

/** Changes something as a part of a step that was taken, unless others were taken since. */
export function joinStep(change: () => void, of: number): void {
  joining = steps.at === of;
  try {
    batch(change);
  } finally {
    joining = false;
  }
}

/** What changes until this is over belongs to the present step. */
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
