/** After the engine was replaced every model is opened anew: the two that are compared first. */
import { batch } from "@preact/signals";
import { onEngineRestart, report } from "../../state/engine";
import {
  modelList,
  reopening,
  SIDES,
  type Side,
  type Slot,
  slotKey,
  slots,
} from "../../state/state";
import { load } from "../opening";
import { openWanted, wantedOf } from "../sources";
import { carry, forgetHandles, putDown } from "./handles";

export function watchEngine(): void {
  onEngineRestart(() => void reopen());
}

/** How often the engine was replaced, so that what was begun before is not finished. */
let engines = 0;

/** The old handles died with the old worker; what is done to the models stays. */
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
  putDown([a, b].flatMap((slot) => slot?.model ?? []));
  await reopenModelList(() => mine === engines);
}

/** Those that are not compared, one after the other. */
async function reopenModelList(isWanted: () => boolean): Promise<void> {
  for (const former of modelList.peek()) {
    const key = slotKey(former);
    const shown = SIDES.map((side) => slots[side].peek()).find(
      (slot) => slot && slotKey(slot) === key,
    );
    const slot = shown ?? (await openAgain(former, isWanted));
    if (!isWanted()) return;
    if (!slot) continue;
    carry(slot.model);
    modelList.value = modelList.peek().map((one) => (slotKey(one) === key ? slot : one));
    putDown([slot.model]);
  }
  reopening.value = false;
}

/** Null where it cannot be opened any more: it then leaves the model list, unless the engine was replaced again. */
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
