/** Asks the engine whether the two models can be compared, and for remedies if not. */
import { effect } from "@preact/signals";
import { EngineFailure, isEngineError, wasAborted } from "../../worker/engine-errors";
import type { Inspection, Notice } from "../../worker/protocol";
import { engineClient, report } from "../state/engine";
import { latest } from "../state/latest";
import { change, inspected, pairKey, settings, slots, spoken } from "../state/state";
import { bytes } from "../text/format";

/** Inspects the pair whenever the models or their preparation change. */
export function watchPair(): void {
  const ask = latest(inspect);
  effect(() => {
    const key = pairKey.value;
    // After a restart of the engine the same models need no new inspection.
    const open = slots.a.value !== null && slots.b.value !== null;
    if (key !== null && open && key !== inspected.peek()?.key) ask(key);
  });
}

async function inspect(key: string): Promise<void> {
  const [a, b] = [slots.a.value, slots.b.value];
  if (!a || !b || key !== pairKey.value) return;
  try {
    const { signal } = new AbortController();
    const inspection = await engineClient().inspect(signal, a.model, b.model, settings.value);
    const before = inspected.value?.inspection.problem?.code;
    inspected.value = { key, inspection };
    const { problem } = inspection;
    if (problem && problem.code !== before) spoken.value = `${problem.message} ${problem.hint}`;
  } catch (thrown) {
    if (wasAborted(thrown) || !isEngineError(thrown) || thrown.code === "engine-stopped") return;
    inspected.value = { key, inspection: unknownPair(thrown) };
  }
}

/** Inspection of a pair that the engine cannot inspect: its error and the facts of the models. */
function unknownPair({ code, message, hint }: Notice): Inspection {
  const [a, b] = [slots.a.peek()?.report, slots.b.peek()?.report];
  return {
    problem: { code, message, hint },
    points: { a: a?.points ?? 0, b: b?.points ?? 0 },
    compared: null,
    triangles: "unknown",
    units: {
      a: { stated: a?.unit ?? "units", guess: null },
      b: { stated: b?.unit ?? "units", guess: null },
    },
    meanDistance: { before: null, now: null, rigid: null, similarity: null, mirrored: null },
    scale: null,
    remedies: [],
    applied: [],
  };
}

/** Largest size of a list of points in bytes. */
const LONGEST_LIST = 64e6;

/** Compares only the points that a file lists. */
export async function takeList(file: File): Promise<void> {
  try {
    if (file.size > LONGEST_LIST) throw tooLong(file);
    const text = await file.text();
    change({
      prepare: { points: await engineClient().points(new AbortController().signal, text) },
    });
    spoken.value = `${file.name} says which points are compared.`;
  } catch (thrown) {
    if (!wasAborted(thrown)) report("pair", thrown);
  }
}

function tooLong(file: File): EngineFailure {
  return new EngineFailure({
    code: "list-too-long",
    message: `“${file.name}” is not a list of vertices: it has ${bytes(file.size)}.`,
    hint: "Choose a text file with one or two whole numbers a line.",
  });
}
