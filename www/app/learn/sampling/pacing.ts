/** How fast steps are taken, and how a single one is told. Pure. */

/** Steps a second, from a walk that can be talked through to one that is only looked at. */
export const SPEEDS = { least: 0.5, most: 1000, usual: 0.8 };

/** Up to so many steps a second each is told part by part; beyond that only their outcome is shown. */
const TOLD_UP_TO = 4;
export const isTold = (perSecond: number) => perSecond <= TOLD_UP_TO;

/** Milliseconds for one step, where somebody asks for a single one. */
export const ONE_STEP_MS = 1250;

export type Phase = "propose" | "compare" | "decide";

const PHASES: readonly (readonly [Phase, number])[] = [
  ["propose", 0.3],
  ["compare", 0.62],
  ["decide", 1],
];

/** Where in the telling of a step `share` of its time is, and how far that phase is. */
export function phaseAt(share: number): { phase: Phase; part: number } {
  let start = 0;
  for (const [phase, end] of PHASES) {
    if (share < end) return { phase, part: (Math.max(0, share) - start) / (end - start) };
    start = end;
  }
  return { phase: "decide", part: 1 };
}

/** Whether what `phase` shows is already said at `share` of a step’s time. */
export function isSaid(phase: Phase, share: number): boolean {
  const order = PHASES.map(([name]) => name);
  return order.indexOf(phaseAt(share).phase) >= order.indexOf(phase);
}

/** Slow, fast, slow: how things move from one place to another. */
export function eased(part: number): number {
  const t = Math.min(1, Math.max(0, part));
  return t * t * (3 - 2 * t);
}

export interface Due {
  steps: number;
  /** The part of a step that is not due yet. */
  carry: number;
}

/** Whole steps that are due after a frame; what an engine cannot keep up with is dropped, not saved up. */
export function due(carry: number, elapsedMs: number, perSecond: number, most: number): Due {
  const wanted = carry + (elapsedMs * perSecond) / 1000;
  const steps = Math.min(most, Math.floor(wanted));
  return { steps, carry: Math.min(1, wanted - steps) };
}

/**
 * The counts at which a growing number of draws is looked at: about a third more each time, each a whole
 * number of draws of every chain, the last of them `last` rounded up to that.
 */
export function stagesOf(last: number, chains: number, first = 16): number[] {
  const whole = (count: number) => Math.ceil(count / chains) * chains;
  const end = whole(last);
  const found: number[] = [];
  for (let count = first; whole(count) < end; count *= 1.35) {
    if (whole(count) !== found.at(-1)) found.push(whole(count));
  }
  return [...found, end];
}

/** 20, 50, 100, 200 … below `draws`, and all of them: where d_G is looked at. */
export function countsUpTo(draws: number): number[] {
  const found: number[] = [];
  for (let decade = 10; 2 * decade < draws; decade *= 10) {
    for (const factor of [2, 5, 10]) if (factor * decade < draws) found.push(factor * decade);
  }
  return [...found, draws];
}

/** How many of `count` draws have fallen after a share of the time: one by one at first, then faster. */
export function rained(share: number, count: number): number {
  return Math.round(count * Math.min(1, share) ** 2);
}
