/** Pure helpers of the coordinator's slicing. */
import type { Stage } from "./protocol";

/** How long one slice of work should take, so that a cancel is seen well within 100 ms. */
export const SLICE_MS = 50;

const FIRST_BUDGET = 64;
const LARGEST_BUDGET = 1 << 20;

export function firstBudget(): number {
  return FIRST_BUDGET;
}

/** The next number of evaluations, from how long the last ones took. */
export function nextBudget(budget: number, milliseconds: number): number {
  const wanted = SLICE_MS / Math.max(milliseconds, 0.5);
  const factor = Math.min(4, Math.max(0.25, wanted));
  return Math.round(Math.min(LARGEST_BUDGET, Math.max(1, budget * factor)));
}

/** Stages that the engine may do in one go, without a chance for a beat. */
export function isIndivisible(stage: Stage): boolean {
  return stage === "prepare" || stage === "fit" || stage === "measure";
}
