/** Checks whether the file at an address, or the example, is still the one that the link was made with. */
import { computed, effect, untracked } from "@preact/signals";
import type { Side } from "../../../worker/protocol";
import { HASH_DIGITS } from "../../state/settings";
import { dismiss, linked, notify, SIDES, slots, spoken } from "../../state/state";
import { nameOf, sourceText } from "../sources";

/** A sentence for each model that has changed since the link was made. */
const differences = computed(() => SIDES.flatMap((side) => difference(side) ?? []));

function difference(side: Side): string | null {
  const [slot, models] = [slots[side].value, linked.value];
  const source = slot && sourceText(slot.source);
  if (!slot || !source || models?.urls?.[side] !== source) return null;
  const found = slot.report.fingerprint?.slice(0, HASH_DIGITS);
  const expected = models.hashes[side];
  // Not checked if the visitor chose another part of the file than the link names.
  const part = models.parts[side] ?? slot.parts[0];
  if (!found || !expected || found.startsWith(expected) || slot.part !== part) return null;
  return `“${nameOf(slot.source)}” is not what the link was made with: its fingerprint is ${found}, ${expected} was expected.`;
}

export function watchContent(): void {
  effect(() => {
    const found = differences.value;
    untracked(() => tell(found.join(" ")));
  });
}

function tell(message: string): void {
  if (message === "") {
    dismiss("content");
    return;
  }
  const hint =
    "The file has changed since. It stays open, but the numbers may differ from those that the link was made with.";
  notify("content", "other-content", message, hint);
  spoken.value = `${message} ${hint}`;
}
