/** Order and names of the open models. Pure. */
import type { Side } from "../../../worker/protocol";
import { type Slot, slotKey } from "../../state/state";

export type Compared = Record<Side, Slot | null>;

/** Whether the list has more models than the two that are compared. */
export function isUsed(models: readonly Slot[]): boolean {
  return models.length > 2;
}

/**
 * The list after `now` are compared instead of `before`. On a model list that is in use the former models stay;
 * else each is replaced by the new one.
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

/** Appends models to a list, each model once. */
export function withModels(models: readonly Slot[], added: readonly Slot[]): Slot[] {
  const next = [...models];
  for (const slot of added) if (indexIn(next, slot) < 0) next.push(slot);
  return next;
}

/** The models with these keys, in that order, and always the two that are compared. */
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

/** Names of the models: with the part if a file has several, numbered if two files have one name. */
export function namesOf(models: readonly Slot[], name: (slot: Slot) => string): string[] {
  const names = models.map((slot) => {
    const own = name(slot);
    return slot.parts.length > 1 ? `${own}, ${slot.part}` : own;
  });
  // Two files with the same name are numbered.
  return names.map((one, i) => {
    const before = names.slice(0, i).filter((other) => other === one).length;
    return before === 0 ? one : `${one} (${before + 1})`;
  });
}
