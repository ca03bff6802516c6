/** Says of a link from an older version, which leaves σ to the engine, that this version chooses another one. */
import { effect, signal } from "@preact/signals";
import { olderSigma } from "../comparison/words";
import { notify, outOfDate, result } from "../state/state";

/** Whether the link that was opened last may mean the σ of an older version. */
export const mayBeOlder = signal(false);

/** Says so with the first result of such a link, if its σ is by a newer rule. */
export function watchOlderLink(): void {
  effect(() => {
    const found = result.value;
    if (!mayBeOlder.value || found === null || found.stored || outOfDate.value) return;
    mayBeOlder.value = false;
    const said = olderSigma(found.report);
    if (said) notify("older-link", "older-sigma", said.message, said.hint);
  });
}
