/** Opens all models again after a restart of the engine, the two that are compared first. */
import { batch } from "@preact/signals";
import type { Side } from "../../../worker/protocol";
import { onEngineRestart, report } from "../../state/engine";
import { modelList, reopening, SIDES, type Slot, slotKey, slots } from "../../state/state";
import { load } from "../opening";
import { openWanted, wantedOf } from "../sources";
import { forgetHandles, release, retain } from "./handles";

export function watchEngine(): void {
  onEngineRestart(() => void reopen());
}

/** Number of restarts of the engine: work from before a restart is dropped. */
let engines = 0;

/** Opens A and B again; the old handles are invalid, the settings stay. */
async function reopen(): Promise<void> {
  engines += 1;
  const mine = engines;
  reopening.value = true;
  forgetHandles();
  const again = (side: Side) => {
    const slot = slots[side].value;
    return slot ? load(side, wantedOf(slot)) : null;
  };
  const [a, b] = await Promise.all([again("a"), again("b")]);
  if (mine !== engines) return;
  batch(() => {
    if (a) slots.a.value = a;
    if (b) slots.b.value = b;
  });
  release([a, b].flatMap((slot) => slot?.model ?? []));
  await reopenModelList(() => mine === engines);
}

/** Opens the other models again, one after the other. */
async function reopenModelList(isWanted: () => boolean): Promise<void> {
  for (const former of modelList.peek()) {
    const key = slotKey(former);
    const shown = SIDES.map((side) => slots[side].peek()).find(
      (slot) => slot && slotKey(slot) === key,
    );
    const slot = shown ?? (await openAgain(former, isWanted));
    if (!isWanted()) return;
    if (!slot) continue;
    retain(slot.model);
    modelList.value = modelList.peek().map((one) => (slotKey(one) === key ? slot : one));
    release([slot.model]);
  }
  reopening.value = false;
}

/** Opens a model again; null if that fails: it is removed from the list, unless the engine was restarted again. */
async function openAgain(former: Slot, isWanted: () => boolean): Promise<Slot | null> {
  try {
    return await openWanted(new AbortController().signal, wantedOf(former), () => {});
  } catch (thrown) {
    if (isWanted()) {
      const key = slotKey(former);
      modelList.value = modelList.peek().filter((slot) => slotKey(slot) !== key);
      report("page", thrown);
    }
    return null;
  }
}
