/** Speed of the animated samplers, and the phases of a single animated step. Pure. */

/** Range of the speed, in steps per second. */
export const SPEEDS = { least: 0.5, most: 1000, usual: 0.8 };

/** Largest speed, in steps per second, at which each step is animated in phases. */
const TOLD_UP_TO = 4;
export const isTold = (perSecond: number) => perSecond <= TOLD_UP_TO;

/** Milliseconds of a single step on request. */
export const ONE_STEP_MS = 1250;

export type Phase = "propose" | "compare" | "decide";

const PHASES: readonly (readonly [Phase, number])[] = [
  ["propose", 0.3],
  ["compare", 0.62],
  ["decide", 1],
];

/** Phase of an animated step after a share of its time, and the share of that phase. */
export function phaseAt(share: number): { phase: Phase; part: number } {
  let start = 0;
  for (const [phase, end] of PHASES) {
    if (share < end) return { phase, part: (Math.max(0, share) - start) / (end - start) };
    start = end;
  }
  return { phase: "decide", part: 1 };
}

/** Whether a phase has begun after a share of the time of a step. */
export function isSaid(phase: Phase, share: number): boolean {
  const order = PHASES.map(([name]) => name);
  return order.indexOf(phaseAt(share).phase) >= order.indexOf(phase);
}

/** Easing of a motion: slow, fast, slow. */
export function eased(part: number): number {
  const t = Math.min(1, Math.max(0, part));
  return t * t * (3 - 2 * t);
}

export interface Due {
  steps: number;
  /** Fraction of the next step. */
  carry: number;
}

/** Number of whole steps after a frame; steps for which the engine is too slow are dropped. */
export function due(carry: number, elapsedMs: number, perSecond: number, most: number): Due {
  const wanted = carry + (elapsedMs * perSecond) / 1000;
  const steps = Math.min(most, Math.floor(wanted));
  return { steps, carry: Math.min(1, wanted - steps) };
}

/**
 * Numbers of draws at which a growing run is evaluated: about a third more each time, each a multiple of the number of
 * chains, up to `last` rounded up.
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

/** Numbers of draws at which d_G is computed: 20, 50, 100, 200 … below `draws`, and `draws`. */
export function countsUpTo(draws: number): number[] {
  const found: number[] = [];
  for (let decade = 10; 2 * decade < draws; decade *= 10) {
    for (const factor of [2, 5, 10]) if (factor * decade < draws) found.push(factor * decade);
  }
  return [...found, draws];
}

/** Number of `count` draws that are shown after a share of the time: one by one at first, then faster. */
export function rained(share: number, count: number): number {
  return Math.round(count * Math.min(1, share) ** 2);
}
