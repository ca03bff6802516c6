/** Shows the specimens of a set, and opens its groups as models. */
import { signal } from "@preact/signals";
import { wasAborted } from "../../worker/engine-errors";
import type { Side, SpecimenTable } from "../../worker/protocol";
import { engineClient, report } from "../state/engine";
import { dismiss, type Files, type Slot, slots, type Wanted } from "../state/state";
import { type Division, FEWEST, readingsOf } from "./division";
import { addModels } from "./list/actions";
import { forget, openPair } from "./opening";
import { withValue } from "./reading";
import { nameOf } from "./sources";

/** The set whose specimens are shown. */
export interface ShownSet {
  side: Side;
  name: string;
  source: Files;
  /** How it is read, but for groups, filters and what is taken out. */
  reading: string;
  table: SpecimenTable;
}

export const shownSet = signal<ShownSet | null>(null);

/** Whose specimens are being read, if any. */
export const readingSpecimens = signal<Side | null>(null);

/** Whether the specimens of a model can be shown: those of the visitor's own files. */
export function isSet(slot: Slot): boolean {
  return slot.origin.kind === "shapes" && slot.source.kind === "files";
}

/** Reads the table of the specimens of a model and shows it. */
export async function showSpecimens(side: Side): Promise<void> {
  const slot = slots[side].peek();
  if (slot?.source.kind !== "files" || readingSpecimens.peek()) return;
  const controller = new AbortController();
  readingSpecimens.value = side;
  dismiss(side);
  try {
    const { source } = slot;
    const table = await engineClient().specimens(controller.signal, source.files, slot.reading);
    const plain = ["group", "where", "adjust"].reduce(
      (reading, key) => withValue(reading, key, null),
      slot.reading,
    );
    shownSet.value = { side, name: nameOf(source), source, reading: plain, table };
  } catch (thrown) {
    if (!wasAborted(thrown)) report(side, thrown);
  } finally {
    readingSpecimens.value = null;
  }
}

/** Opens the two groups as A and B. */
export async function compareGroups(set: ShownSet, division: Division): Promise<void> {
  shownSet.value = null;
  const { a, b } = readingsOf(set.reading, division);
  const wanted = (reading: string): Wanted => ({ source: set.source, part: null, reading });
  await openPair(wanted(a), wanted(b), forget());
}

/** Adds a model of every group of a column to the list of models. */
export async function modelOfEachGroup(set: ShownSet, division: Division): Promise<void> {
  const column = set.table.columns.find(({ name }) => name === division.column);
  const words = (column?.values ?? []).filter(({ count }) => count >= FEWEST);
  shownSet.value = null;
  await addModels(
    words.map(({ word }) => ({
      source: set.source,
      part: null,
      reading: readingsOf(set.reading, { ...division, a: word, b: null, threshold: null }).a,
    })),
  );
}
