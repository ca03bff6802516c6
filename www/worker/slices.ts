/** Pure helpers of the coordinator's slicing. */
import type { Stage } from "./protocol";

/** How long one slice of work should take, so that a cancel is seen well within 100 ms. */
export const SLICE_MS = 50;

const FIRST_BUDGET = 64;
const LARGEST_BUDGET = 1 << 20;

export function firstBudget(): number {
  return FIRST_BUDGET;
}

/**
 * The next number of evaluations, from how many were done in how long. Work that evaluates nothing
 * says nothing of what an evaluation costs.
 */
export function nextBudget(budget: number, evaluated: number, milliseconds: number): number {
  if (evaluated <= 0) return budget;
  const wanted = (evaluated * SLICE_MS) / Math.max(milliseconds, 0.5);
  return Math.round(Math.min(LARGEST_BUDGET, 4 * budget, Math.max(1, wanted)));
}

/** Stages that the engine may do in one go, without a chance for a beat. */
export function isIndivisible(stage: Stage): boolean {
  return stage === "prepare" || stage === "fit" || stage === "measure";
}
