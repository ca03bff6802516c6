/** Requests shapes of either model and the nearest that the other can make, for the view Pairs. */
import { computed, effect, signal } from "@preact/signals";
import { wasAborted } from "../../worker/engine-errors";
import type { Pairing, Region, Side, Sides } from "../../worker/protocol";
import { engineClient, onEngineRestart, report } from "../state/engine";
import { latest } from "../state/latest";
import { DIFFERENCE_OF, letters } from "../state/regions";
import { held, pairRank, SIDES, unit, view } from "../state/state";
import { count, length } from "../text/format";

interface Found {
  /** Key of the comparison. */
  key: string;
  rank: number;
  pairings: Sides<Pairing>;
}

const found = signal<Found | null>(null);

/** The pairs of the comparison that the engine holds; while its slider moves those of the place before. */
export const pairings = computed<Sides<Pairing> | null>(() => {
  const last = found.value;
  return last && (held.value === null || held.value.key === last.key) ? last.pairings : null;
});

/** A shape and the nearest of the other model, by the region where they are drawn. */
export const pairedShapes = computed(() => {
  const shapes: Partial<Record<Region, readonly [Float32Array, Float32Array]>> = {};
  for (const side of SIDES) {
    const pairing = pairings.value?.[side];
    if (pairing) shapes[DIFFERENCE_OF[side]] = [pairing.shape, pairing.nearest];
  }
  return shapes;
});

/** Says which shapes are shown, and how far they lie from the other model; empty until they have come. */
export const pairsSentence = computed(() => {
  const shown = pairings.value;
  return shown ? SIDES.map((side) => sentenceOf(side, shown[side], unit.value)).join(" ") : "";
});

export function sentenceOf(side: Side, pairing: Pairing, symbol: string): string {
  const [own, other] = letters(side);
  const { number, count: of, known, distance } = pairing;
  const which = known
    ? `shape ${count(number)} of the ${count(of)} known of ${own}`
    : `a random shape of ${own}`;
  if (distance === 0) return `${own}∖${other}: ${which}, which ${other} makes exactly.`;
  return `${own}∖${other}: ${which}, then the nearest that ${other} can make, ${length(distance, symbol)} away.`;
}

const ask = latest(async ({ key, rank }: { key: string; rank: number }) => {
  const { signal: never } = new AbortController();
  try {
    const [a, b] = await Promise.all(
      SIDES.map((side) => engineClient().pairing(never, side, rank / 100)),
    );
    if (a && b) found.value = { key, rank, pairings: { a, b } };
  } catch (thrown) {
    if (!wasAborted(thrown)) report("page", thrown);
  }
});

/** Requests the pairs when the view shows them and the comparison or their rank changes. */
export function watchPairs(): void {
  effect(() => {
    const [now, rank] = [held.value, pairRank.value];
    if (view.value !== "pairs" || now === null) return;
    const last = found.peek();
    if (last?.key !== now.key || last.rank !== rank) ask({ key: now.key, rank });
  });
  onEngineRestart(() => {
    found.value = null;
  });
}
