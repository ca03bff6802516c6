/** Requests the explored shape and its nearest shapes from the engine, one request at a time, always the latest. */
import { batch, effect } from "@preact/signals";
import { sentenceOf, wasAborted } from "../../../worker/engine-errors";
import type { AxesKind, Explored, Space } from "../../../worker/protocol";
import { engineClient } from "../../state/engine";
import { coefficientsOf, type ExplorerState } from "../../state/explorer";
import {
  type Answer,
  answer,
  askable,
  basis,
  explorer,
  type Grab,
  grab,
  ownOf,
  runningKey,
  runStage,
  trouble,
} from "../../state/exploring";
import { latest } from "../../state/latest";
import { otherSide } from "../../state/regions";
import { currentKey, run, slots, tab } from "../../state/state";
import { timed } from "../../viewer/timing";

interface Wanted {
  key: string;
  state: ExplorerState;
}

/** Sends a request whenever the choice changes while the explorer is shown. */
export function watchExplorer(): void {
  effect(() => {
    if (run.value?.progress === null) runningKey.value = currentKey.peek();
  });
  effect(() => {
    if (tab.value !== "explore") return;
    const key = askable.value;
    const state = explorer.value;
    // A failed request is sent again when the run has advanced.
    runStage.value;
    if (key === null) return;
    if (!hasBasis(key, state)) askBasis({ key, state });
    else if (!isAnswered(key, state)) ask({ key, state });
  });
}

function hasBasis(key: string, { space, kind }: ExplorerState): boolean {
  const found = basis.value;
  return found?.key === key && found.axes.space === space && found.axes.kind === kind;
}

function isAnswered(key: string, { space, kind, seed, own }: ExplorerState): boolean {
  const found = answer.peek();
  return (
    found?.key === key &&
    found.space === space &&
    found.kind === kind &&
    found.seed === seed &&
    found.own === own
  );
}

/** Whether an answer belongs to the chosen model and directions. */
function isWanted(key: string, { space, kind }: ExplorerState): boolean {
  const now = explorer.peek();
  return askable.peek() === key && now.space === space && now.kind === kind;
}

const never = new AbortController().signal;

const askBasis = latest(async ({ key, state }: Wanted) => {
  if (!isWanted(key, state) || hasBasis(key, state)) return;
  const { space, kind } = state;
  try {
    const axes = await engineClient().axes(never, space, kind);
    const { shape } = await engineClient().explore(never, space, kind, [], false);
    if (isWanted(key, state)) basis.value = { key, axes, mean: shape };
  } catch (thrown) {
    fail(thrown);
  }
});

const ask = latest(async ({ key, state }: Wanted) => {
  const { space, kind, seed, own } = state;
  const count = basis.peek()?.axes.values.length ?? 0;
  const along = coefficientsOf(state, count);
  try {
    const [explored, partner] = await timed("engine and message", () =>
      Promise.all([
        engineClient().explore(never, space, kind, along, true),
        partnerOf(space, kind, along),
      ]),
    );
    if (!isWanted(key, state)) return;
    const found: Answer = { key, space, kind, seed, own, explored, partner };
    batch(() => {
      answer.value = found;
      trouble.value = null;
    });
  } catch (thrown) {
    fail(thrown);
  }
});

/** The partner shape of a principal angle in the other model, with the same coefficient. */
async function partnerOf(space: Space, kind: AxesKind, along: number[]): Promise<Explored | null> {
  if (kind !== "angles" || space === "intersection") return null;
  return engineClient().explore(never, otherSide(space), kind, along, false);
}

function fail(thrown: unknown): void {
  if (!wasAborted(thrown)) trouble.value = sentenceOf(thrown);
}

/** Begins to drag a vertex of the shape. */
export function takeVertex(vertex: number): Grab | null {
  const found = answer.peek();
  const { space, own } = explorer.peek();
  const size = basis.peek()?.mean.length ?? 0;
  if (!found || found.space !== space || size === 0) return null;
  const held = grab.peek();
  if (held?.vertex === vertex && held.space === space && held.own === own) return held;
  const { shape, coefficients } = found.explored;
  const from = positionOf(shape, vertex);
  if (!from) return null;
  const taken = { space, vertex, base: Array.from(coefficients), from, to: from, own };
  grab.value = taken;
  return taken;
}

export function positionOf(shape: Float32Array, vertex: number): number[] | null {
  const dimension = slots.a.peek()?.report.dimension ?? 3;
  const found = Array.from(shape.subarray(vertex * dimension, (vertex + 1) * dimension));
  return found.length === dimension ? found : null;
}

/** Moves the dragged vertex: asks for the shape of least change that has it at the new position. */
export function moveVertex(to: number[]): void {
  const held = grab.peek();
  if (!held) return;
  grab.value = { ...held, to };
  askDrag({ vertex: held.vertex, to });
}

const askDrag = latest(async ({ vertex, to }: { vertex: number; to: number[] }) => {
  const key = askable.peek();
  const held = grab.peek();
  if (key === null || held?.vertex !== vertex) return;
  const { space, base } = held;
  try {
    const explored = await engineClient().drag(never, space, base, vertex, to, true);
    const still = grab.peek();
    const now = explorer.peek();
    // If a slider was moved meanwhile, the drag continues from that shape.
    if (still?.vertex !== vertex || now.own !== still.own || now.space !== space) return;
    const own = ownOf(explored.coefficients);
    batch(() => {
      grab.value = { ...still, own };
      answer.value = { key, space, kind: "modes", seed: null, own, explored, partner: null };
      explorer.value = { ...now, kind: "modes", seed: null, own };
      trouble.value = null;
    });
  } catch (thrown) {
    fail(thrown);
  }
});
