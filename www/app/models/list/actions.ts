/** Adds models to the model list, removes them, and chooses which two of them are compared. */
import { EngineFailure, sentenceOf, wasAborted } from "../../../worker/engine-errors";
import type { Side } from "../../../worker/protocol";
import { report } from "../../state/engine";
import { otherSide } from "../../state/regions";
import {
  addingModels,
  demo,
  dismiss,
  modelList,
  type ReadProgress,
  type Slot,
  type Source,
  settings,
  slotKey,
  slots,
  spoken,
  tab,
  type Wanted,
} from "../../state/state";
import { currentStep, joinStep } from "../../state/undo";
import { choosing, forget, openPair } from "../opening";
import { first, isOpen, type NamedSource, nameOf, openWanted, wantedOf } from "../sources";
import { closeUnused, release, retain } from "./handles";
import { pairSettings } from "./measures";
import { arranged, isSame, isUsed, withModels } from "./order";

let opening: AbortController | null = null;

/**
 * Opens models one after the other and adds all of them to the model list in one step of undo: the given step of
 * the history, if it still is the present one.
 */
export async function addModels(wanted: Wanted[], step: number | null = null): Promise<void> {
  dismiss("page");
  const added = await openAll(wanted);
  if (added === null) return;
  const add = () => {
    modelList.value = withModels(modelList.value, added);
  };
  if (step === null) add();
  else joinStep(add, step);
  release(added.map(({ model }) => model));
  if (added.length > 0) spoken.value = `${modelList.value.length} models are open.`;
}

/** Opens the models that a link or a step of the history has on the model list, in its order. */
export async function restoreModelList(wanted: Wanted[]): Promise<void> {
  const begun = currentStep();
  const added = await openAll(wanted);
  if (added === null) return;
  joinStep(() => arrange(wanted, added), begun);
  release(added.map(({ model }) => model));
}

/** Reduces the model list to these models, in this order, and the two that are compared. */
export function arrange(wanted: Wanted[], added: readonly Slot[] = []): void {
  const open = withModels(modelList.value, added);
  const keys = wanted.flatMap((one) => open.find((slot) => isOpen(slot, one)) ?? []).map(slotKey);
  modelList.value = arranged(open, keys, { a: slots.a.value, b: slots.b.value });
}

/** Cancels the opening of further models; those that are open stay. */
export function cancelAdding(): void {
  opening?.abort("enough");
}

/** Cancels the opening and drops its models. */
export function giveUpAdding(): void {
  opening?.abort("discard");
  opening = null;
  addingModels.value = null;
}

/** Opens the models that are not on the list yet and holds them; null if the opening was dropped. */
async function openAll(wanted: Wanted[]): Promise<Slot[] | null> {
  giveUpAdding();
  const controller = new AbortController();
  opening = controller;
  const { signal } = controller;
  const added: Slot[] = [];
  const failed: { name: string; thrown: unknown }[] = [];
  for (const [done, one] of wanted.entries()) {
    if (signal.aborted) break;
    if ([...modelList.peek(), ...added].some((slot) => isOpen(slot, one))) continue;
    const name = nameOf(one.source);
    const tell = (read: ReadProgress | null) => {
      if (opening === controller) addingModels.value = { name, read, done, of: wanted.length };
    };
    tell(null);
    try {
      const slot = await openWanted(signal, one, tell);
      retain(slot.model);
      added.push(slot);
    } catch (thrown) {
      if (!signal.aborted && !wasAborted(thrown)) failed.push({ name, thrown });
    }
  }
  if (opening === controller) {
    opening = null;
    addingModels.value = null;
  }
  if (signal.reason === "discard") {
    release(added.map(({ model }) => model));
    return null;
  }
  tellFailed(failed);
  return added;
}

function tellFailed(failed: { name: string; thrown: unknown }[]): void {
  const [one] = failed;
  if (!one) return;
  const names = failed.map(({ name }) => `“${name}”`).join(", ");
  const all = new EngineFailure({
    code: "models",
    message: `${failed.length} models cannot be opened: ${names}. ${sentenceOf(one.thrown)}`,
    hint: one.thrown instanceof EngineFailure ? one.thrown.hint : "",
  });
  report("page", failed.length === 1 ? one.thrown : all);
}

/** Removes a model from the model list; the two that are compared stay. */
export function removeModel(slot: Slot): void {
  if (isSame(slot, slots.a.value) || isSame(slot, slots.b.value)) return;
  modelList.value = modelList.value.filter((one) => !isSame(one, slot));
  closeUnused();
  spoken.value = `${nameOf(slot.source)} is closed. It can be undone.`;
}

/** Removes all models but the two that are compared. */
export function keepCompared(): void {
  const { a, b } = { a: slots.a.value, b: slots.b.value };
  modelList.value = modelList.value.filter((slot) => isSame(slot, a) || isSame(slot, b));
  closeUnused();
}

/** Compares the pair of a cell with the settings of the table, and shows its regions. */
export async function comparePair(a: Slot, b: Slot): Promise<void> {
  const change = (side: Side, slot: Slot) =>
    isSame(slot, slots[side].value) ? null : wantedOf(slot);
  const [nextA, nextB] = [change("a", a), change("b", b)];
  if (nextA === null && nextB === null) {
    tab.value = "regions";
    return;
  }
  await openPair(nextA, nextB, () => {
    settings.value = pairSettings(settings.value);
    tab.value = "regions";
  });
}

/** Chooses a model of the list as A or B; if it was the other one, A and B are exchanged. */
export async function chooseFor(side: Side, slot: Slot): Promise<void> {
  const other = otherSide(side);
  const former = slots[side].value;
  const swaps = former !== null && isSame(slot, slots[other].value);
  const wanted = { [side]: wantedOf(slot), [other]: swaps ? wantedOf(former) : null };
  await openPair(wanted.a ?? null, wanted.b ?? null);
}

/** Adds all dropped models to the model list; `a` and `b` of them are compared, null keeps the present one. */
export async function openEvery(
  models: NamedSource[],
  a: Source | null,
  b: Source | null,
): Promise<void> {
  choosing.value = null;
  tab.value = "models";
  // A pair that came with the page is removed; models that the visitor opened stay.
  const former = isUsed(modelList.value) || demo.value !== null ? [] : [...modelList.value];
  for (const { model } of former) retain(model);
  const begun = currentStep();
  const changed = await openPair(a && first(a), b && first(b), () => {
    forget()();
    modelList.value = withModels(former, modelList.value);
  });
  release(former.map(({ model }) => model));
  const wanted = models.map(({ source }) => first(source));
  await addModels(wanted, changed ? begun + 1 : null);
}
