/** Which models are open, in which order. Pure. */
import { type Side, type Slot, slotKey } from "../../state/state";

export type Compared = Record<Side, Slot | null>;

/** Whether more models are kept than two that are compared. */
export function isUsed(models: readonly Slot[]): boolean {
  return models.length > 2;
}

/**
 * The list once `now` are compared in place of `before`. What was compared stays on a model list that is in
 * use; else it makes way, and what comes instead takes its place.
 */
export function afterChoice(models: readonly Slot[], before: Compared, now: Compared): Slot[] {
  const stays = isUsed(models);
  const kept = (slot: Slot) => stays || isSame(slot, now.a) || isSame(slot, now.b);
  const next: (Slot | null)[] = [...models];
  for (const side of ["a", "b"] as const) {
    const [former, slot] = [before[side], now[side]];
    if (!slot || indexIn(next, slot) >= 0) continue;
    const index = former && !kept(former) ? indexIn(next, former) : -1;
    if (index >= 0) next[index] = slot;
    else next.push(slot);
  }
  const list = next.flatMap((slot) => slot ?? []).filter(kept);
  return list.map((slot) => [now.a, now.b].find((one) => isSame(slot, one)) ?? slot);
}

/** With others at the end, each model once. */
export function withModels(models: readonly Slot[], added: readonly Slot[]): Slot[] {
  const next = [...models];
  for (const slot of added) if (indexIn(next, slot) < 0) next.push(slot);
  return next;
}

/** Those of `keys` that there are, in that order, and the two that are compared in any case. */
export function arranged(open: readonly Slot[], keys: readonly string[], now: Compared): Slot[] {
  const wanted = keys.flatMap((key) => open.find((slot) => slotKey(slot) === key) ?? []);
  return withModels(
    wanted,
    [now.a, now.b].flatMap((slot) => slot ?? []),
  );
}

export function isSame(one: Slot, other: Slot | null): boolean {
  return other !== null && slotKey(one) === slotKey(other);
}

function indexIn(list: readonly (Slot | null)[], wanted: Slot): number {
  return list.findIndex((slot) => slot !== null && isSame(wanted, slot));
}

/** What each model is called beside the others: with its part where its file has several. */
export function namesOf(models: readonly Slot[], name: (slot: Slot) => string): string[] {
  const names = models.map((slot) => {
    const own = name(slot);
    return slot.parts.length > 1 ? `${own}, ${slot.part}` : own;
  });
  // Two files of one name are told apart by number.
  return names.map((one, i) => {
    const before = names.slice(0, i).filter((other) => other === one).length;
    return before === 0 ? one : `${one} (${before + 1})`;
  });
}
