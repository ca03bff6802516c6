/** Opens models as A or B. If a model cannot be opened the former one stays. */
import { batch, signal } from "@preact/signals";
import { EngineFailure, wasAborted } from "../../worker/engine-errors";
import type { DroppedFile, Side } from "../../worker/protocol";
import type { Demo } from "../state/demos";
import { engineClient, report } from "../state/engine";
import { withoutSides } from "../state/preparation";
import {
  change,
  compared,
  demo,
  dismiss,
  emptyRegions,
  type Files,
  lockedRange,
  modelList,
  notify,
  opening,
  painting,
  type ReadProgress,
  reopening,
  SIDES,
  type Slot,
  type Source,
  settings,
  slots,
  sourceKey,
  spoken,
  type Wanted,
} from "../state/state";
import { closeUnused, release, retain } from "./list/handles";
import { afterChoice } from "./list/order";
import { withWord, wordOf } from "./reading";
import { mayBeShapesOf } from "./shapes";
import {
  baseName,
  demoSource,
  filesSource,
  first,
  isOpen,
  type NamedSource,
  nameOf,
  type OnRead,
  openWanted,
  wantedOf,
} from "./sources";

const loads: Record<Side, AbortController | null> = { a: null, b: null };

/** More than two dropped models, of which two are still to be chosen. */
export const choosing = signal<NamedSource[] | null>(null);

/** Shapes that were dropped where a model from a file is open: a model of their own, or the shapes of that model. */
export interface Offered {
  side: Side;
  shapes: Files;
}

/** Shapes of which is still to be chosen what they are. */
export const offered = signal<Offered | null>(null);

/** Opens the example of an address, with the settings of the address. */
export function demoModels({ a, b }: Demo): Record<Side, Wanted> {
  return { a: first(demoSource(a)), b: first(demoSource(b)) };
}

/** Opens the example that a visitor chooses, with its own σ. */
export async function chooseDemo(chosen: Demo): Promise<void> {
  const { a, b } = demoModels(chosen);
  await openPair(a, b, forget(chosen.sigma ?? null));
}

/**
 * Opens A and B together, so that no old model is compared with a new one in between. `alongside` is changed in the
 * same step. Resolves to whether anything changed: nothing does if neither can be opened.
 */
export async function openPair(
  a: Wanted | null,
  b: Wanted | null,
  alongside: () => void = () => {},
): Promise<boolean> {
  const opened = await Promise.all([a && load("a", a), b && load("b", b)]);
  const some = opened.some((slot) => slot !== null);
  if (some) show({ a: opened[0], b: opened[1] }, alongside);
  release(opened.flatMap((slot) => slot?.model ?? []));
  return some;
}

/** Resets settings that are lengths: those of the former models do not apply to new ones. */
export function forget(sigma: number | null = null): () => void {
  return () => change({ sigma, noise: null, differenceThreshold: null });
}

/** Opens dropped or chosen files: one model as A or B as asked, two as A and B. */
export async function openModels(files: DroppedFile[], side: Side): Promise<void> {
  if (files.length === 0) return;
  dismiss("page");
  const models = await modelsIn(files, side);
  const [one, two, ...rest] = models ?? [];
  if (!one || !models) return;
  if (rest.length > 0) {
    choosing.value = models;
    spoken.value = `${models.length} models were found. Choose two of them.`;
  } else if (two) {
    await openPair(first(one.source), first(two.source), forget());
  } else if (mayBeShapesOf(slots[side].peek(), one.source)) {
    offered.value = { side, shapes: one.source };
  } else {
    await openSource(side, one.source);
  }
}

/** Opens the shapes that were offered as a model of their own. */
export async function openOffered({ side, shapes }: Offered): Promise<void> {
  offered.value = null;
  await openSource(side, shapes);
}

/** Takes the shapes that were offered as those of the model that is open. */
export async function addOffered({ side, shapes }: Offered): Promise<void> {
  offered.value = null;
  await addShapes(side, shapes);
}

/** Opens the two that were chosen of several models; null keeps the present one. */
export async function openChosen(a: Source | null, b: Source | null): Promise<void> {
  choosing.value = null;
  if (a && b) await openPair(first(a), first(b), forget());
  else if (a) await openSource("a", a);
  else if (b) await openSource("b", b);
}

async function openSource(side: Side, source: Source): Promise<void> {
  // If one of the present models stays, σ is kept.
  const alongside = demo.peek() === null ? undefined : forget();
  await reread(side, first(source), alongside);
}

async function reread(side: Side, wanted: Wanted, alongside?: () => void): Promise<void> {
  await openPair(side === "a" ? wanted : null, side === "b" ? wanted : null, alongside);
}

/** The models in these files; null if they cannot be read. */
export async function modelsIn(
  files: DroppedFile[],
  side: Side | null,
): Promise<NamedSource[] | null> {
  const groups = await grouped(files, side);
  return (
    groups?.map((group) => {
      const own = group.files.flatMap((index) => files[index] ?? []);
      return { name: group.name, source: filesSource(group.name, own, group.leftOut) };
    }) ?? null
  );
}

/** Groups files that belong together; null if they cannot be read. */
async function grouped(files: DroppedFile[], side: Side | null) {
  const [only] = files;
  if (only && files.length === 1) return [{ name: baseName(only.name), files: [0], leftOut: [] }];
  const controller = side ? begin(side, `${files.length} files`) : new AbortController();
  try {
    const groups = await engineClient().groups(controller.signal, files);
    if (groups.length > 0) return groups;
    throw new EngineFailure({
      code: "no-models",
      message: `None of the ${files.length} files is a shape model.`,
      hint: "Open models, or a folder of meshes with the same points in the same order.",
    });
  } catch (thrown) {
    if (!wasAborted(thrown)) report("page", thrown);
    return null;
  } finally {
    if (side) end(side, controller);
  }
}

/** Opens another part of the same file. */
export async function choosePart(side: Side, part: string): Promise<void> {
  const slot = slots[side].value;
  if (!slot || part === slot.part) return;
  await reread(side, { ...wantedOf(slot), part });
}

/** Reads the file of a model in another way. */
export async function chooseReading(side: Side, reading: string): Promise<void> {
  const slot = slots[side].value;
  if (slot) await reread(side, { ...wantedOf(slot), reading });
}

/** Computes the model of a set of shapes again, with or without scaling them to one size. */
export async function chooseScale(side: Side, scale: boolean): Promise<void> {
  const slot = slots[side].value;
  if (slot) await chooseReading(side, withWord(slot.reading, "scale", scale));
}

/** Takes shapes as the training or test shapes of a model, whichever they are. */
export async function addShapes(side: Side, shapes: Files): Promise<void> {
  const slot = slots[side].value;
  if (slot) await reread(side, { ...wantedOf(slot), shapes });
}

/** Takes back the shapes beside a model. */
export async function removeShapes(side: Side): Promise<void> {
  const slot = slots[side].value;
  if (slot) await reread(side, { ...wantedOf(slot), shapes: null });
}

export async function openParts(source: Source, a: string, b: string): Promise<void> {
  const part = (name: string): Wanted => ({ source, part: name, reading: "" });
  await openPair(part(a), part(b), forget());
}

/** Cancels the opening of a model; the former one stays. */
export function cancelOpening(side: Side): void {
  loads[side]?.abort();
  spoken.value = `Opening model ${side} was cancelled.`;
}

function show(opened: Record<Side, Slot | null>, alongside: () => void): void {
  batch(() => {
    const sides = { a: replaces("a", opened.a), b: replaces("b", opened.b) };
    if (sides.a || sides.b) change({ prepare: withoutSides(settings.value.prepare, sides) });
    const before = { a: slots.a.value, b: slots.b.value };
    for (const side of SIDES) {
      const slot = opened[side];
      if (!slot) continue;
      slots[side].value = slot;
      opening[side].value = null;
    }
    const now = { a: slots.a.value, b: slots.b.value };
    modelList.value = afterChoice(modelList.value, before, now);
    // Each population is in the frame of its own first shape: the two models must be aligned to each other.
    const populations = SIDES.every((side) => slots[side].value?.origin.kind === "shapes");
    if (populations && !areGroupsOfOneSet(now) && settings.value.align === "none")
      change({ align: "rigid" });
    emptyRegions.value = {};
    // The locked range of the former models no longer applies; that of a link which opens the page stays.
    if (before.a || before.b) lockedRange.value = null;
    compared.value = null;
    painting.value = null;
    dismiss("run");
    dismiss("pair");
    alongside();
  });
  closeUnused();
}

/** Whether A and B are groups of one set, which are in one frame. */
function areGroupsOfOneSet({ a, b }: Record<Side, Slot | null>): boolean {
  const isGroup = (slot: Slot | null) => slot !== null && wordOf(slot.reading, "group") !== null;
  return isGroup(a) && isGroup(b) && a?.source === b?.source;
}

/** Resets the settings of one model when it is replaced: unit, number of modes, list of points. */
function replaces(side: Side, slot: Slot | null): boolean {
  const former = slots[side].value;
  if (!slot || !former) return false;
  return sourceKey(slot.source) !== sourceKey(former.source) || slot.part !== former.part;
}

function begin(side: Side, name: string): AbortController {
  loads[side]?.abort();
  const controller = new AbortController();
  loads[side] = controller;
  opening[side].value = { name, read: null };
  dismiss(side);
  return controller;
}

function end(side: Side, controller: AbortController): void {
  if (loads[side] !== controller) return;
  loads[side] = null;
  opening[side].value = null;
}

/** Opens a model; null if that failed or another was requested meanwhile. The caller must release it. */
export async function load(side: Side, wanted: Wanted): Promise<Slot | null> {
  const { source } = wanted;
  const name = nameOf(source);
  const controller = begin(side, name);
  const onRead = (read: ReadProgress) => {
    if (loads[side] === controller) opening[side].value = { name, read };
  };
  const again = source.kind === "url" ? () => void reread(side, wanted) : null;
  try {
    const slot = await openToShow(controller.signal, wanted, onRead);
    if (source.kind !== "demo") spoken.value = `${name} opened as model ${side}.`;
    return slot;
  } catch (thrown) {
    const choose = (reading: string) => void reread(side, { ...wanted, reading });
    if (!wasAborted(thrown)) report(side, thrown, again, choose);
    else if (again && loads[side] === controller && slots[side].peek() === null) {
      notify(side, "not-downloaded", `“${name}” was not downloaded.`, "", again);
    }
    return null;
  } finally {
    end(side, controller);
  }
}

/** A model with its geometry; one of the model list is not opened again. The caller must release it. */
async function openToShow(signal: AbortSignal, wanted: Wanted, onRead: OnRead): Promise<Slot> {
  const kept = reopening.peek() ? undefined : modelList.peek().find((slot) => isOpen(slot, wanted));
  const slot = kept ?? (await openWanted(signal, wanted, onRead));
  retain(slot.model);
  try {
    const geometry = slot.geometry ?? (await engineClient().geometry(signal, slot.model));
    return slot.geometry === geometry ? slot : { ...slot, geometry };
  } catch (thrown) {
    release([slot.model]);
    throw thrown;
  }
}

/** Cancels the opening of A and B. */
export function giveUpOpening(): void {
  for (const side of SIDES) loads[side]?.abort();
}
