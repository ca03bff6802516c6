/** Opening models into the two slots. A model that cannot be opened leaves the former one. */
import { batch, signal } from "@preact/signals";
import { EngineFailure, wasAborted } from "../worker/engine-errors";
import type { DroppedFile, OpenedModel } from "../worker/protocol";
import { type Demo, packagedFile } from "./demos";
import { engineClient, onEngineRestart, report } from "./engine";
import { withoutSides } from "./preparation";
import {
  change,
  compared,
  demo,
  dismiss,
  emptyRegions,
  lockedRange,
  opening,
  painting,
  SIDES,
  type Side,
  type Slot,
  type Source,
  settings,
  slots,
  sourceKey,
  spoken,
  type Wanted,
} from "./state";

const loads: Record<Side, AbortController | null> = { a: null, b: null };
let fileSerial = 0;

export interface NamedSource {
  name: string;
  source: Source;
}

/** More models than two were dropped, and nobody has said yet which are meant. */
export const choosing = signal<NamedSource[] | null>(null);

function first(source: Source): Wanted {
  return { source, part: null, scale: false };
}

function filesSource(name: string, files: DroppedFile[]): Source {
  fileSerial += 1;
  return { kind: "files", name, files, serial: fileSerial };
}

/** A demo that an address asks for, with whatever settings. */
export function demoModels({ a, b }: Demo): Record<Side, Wanted> {
  return { a: first({ kind: "demo", name: a }), b: first({ kind: "demo", name: b }) };
}

/** A demo that a visitor chooses, with the σ that suits it. */
export async function chooseDemo(chosen: Demo): Promise<void> {
  const { a, b } = demoModels(chosen);
  await openPair(a, b, forget(chosen.sigma ?? null));
}

/**
 * Both change at once, so that no comparison of an old with a new one begins between. `alongside` is
 * changed in the same step.
 */
export async function openPair(
  a: Wanted | null,
  b: Wanted | null,
  alongside: () => void = () => {},
): Promise<void> {
  const opened = await Promise.all([a && load("a", a), b && load("b", b)]);
  show({ a: opened[0], b: opened[1] }, alongside);
}

/** Lengths in use, those of the former models, say nothing of these. */
function forget(sigma: number | null = null): () => void {
  return () => change({ sigma, noise: null, differenceThreshold: null });
}

/** Files that were dropped or chosen: one model fills the slot it was meant for, two fill both. */
export async function openFiles(files: DroppedFile[], side: Side): Promise<void> {
  if (files.length === 0) return;
  dismiss("page");
  const groups = await grouped(files, side);
  if (groups === null) return;
  const models = groups.map((group) => {
    const own = group.files.flatMap((index) => files[index] ?? []);
    return { name: group.name, source: filesSource(group.name, own) };
  });
  const [one, two, ...rest] = models;
  if (!one) return;
  if (rest.length > 0) {
    choosing.value = models;
    spoken.value = `${models.length} models were found. Choose two of them.`;
  } else if (two) {
    await openPair(first(one.source), first(two.source), forget());
  } else {
    await openSource(side, one.source);
  }
}

/** What was chosen of several models; null keeps the one that is there. */
export async function openChosen(a: Source | null, b: Source | null): Promise<void> {
  choosing.value = null;
  if (a && b) await openPair(first(a), first(b), forget());
  else if (a) await openSource("a", a);
  else if (b) await openSource("b", b);
}

async function openSource(side: Side, source: Source): Promise<void> {
  // Whoever compares several models with one of their own keeps the σ they chose.
  const alongside = demo.peek() === null ? undefined : forget();
  await reread(side, first(source), alongside);
}

async function reread(side: Side, wanted: Wanted, alongside?: () => void): Promise<void> {
  await openPair(side === "a" ? wanted : null, side === "b" ? wanted : null, alongside);
}

/** Which files belong together; null where they cannot be looked at. */
async function grouped(files: DroppedFile[], side: Side) {
  const [only] = files;
  if (only && files.length === 1) return [{ name: baseName(only.name), files: [0] }];
  const controller = begin(side, `${files.length} files`);
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
    end(side, controller);
  }
}

/** Another model of the same file. */
export async function choosePart(side: Side, part: string): Promise<void> {
  const slot = slots[side].value;
  if (!slot || part === slot.part) return;
  await reread(side, { source: slot.source, part, scale: slot.scale });
}

/** The shapes of a set, with or without their sizes. */
export async function chooseScale(side: Side, scale: boolean): Promise<void> {
  const slot = slots[side].value;
  if (slot) await reread(side, { source: slot.source, part: slot.part, scale });
}

export async function openParts(source: Source, a: string, b: string): Promise<void> {
  const part = (name: string): Wanted => ({ source, part: name, scale: false });
  await openPair(part(a), part(b), forget());
}

/** Gives up what is being opened; the former model stays. */
export function cancelOpening(side: Side): void {
  loads[side]?.abort();
  spoken.value = `Opening model ${side} was cancelled.`;
}

function show(opened: Record<Side, Slot | null>, alongside: () => void): void {
  batch(() => {
    const sides = { a: replaces("a", opened.a), b: replaces("b", opened.b) };
    if (sides.a || sides.b) change({ prepare: withoutSides(settings.value.prepare, sides) });
    for (const side of SIDES) {
      const slot = opened[side];
      if (!slot) continue;
      const former = slots[side].value;
      if (former) engineClient().close(former.model);
      slots[side].value = slot;
      opening[side].value = null;
    }
    // Every population lies in the frame of its own first shape: side by side those mean nothing.
    const populations = SIDES.every((side) => slots[side].value?.origin.kind === "shapes");
    if ((opened.a || opened.b) && populations && settings.value.align === "none") {
      change({ align: "rigid" });
    }
    emptyRegions.value = {};
    lockedRange.value = null;
    compared.value = null;
    painting.value = null;
    dismiss("run");
    dismiss("pair");
    alongside();
  });
}

/** A declared unit, a number of modes and a list of points are about one model. */
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

/** Null if it failed or another was asked for meanwhile. */
async function load(side: Side, wanted: Wanted): Promise<Slot | null> {
  const { source } = wanted;
  const name = nameOf(source);
  const controller = begin(side, name);
  const onRead = (bytes: number, of: number) => {
    if (loads[side] === controller) opening[side].value = { name, read: { bytes, of } };
  };
  try {
    const slot = await openWanted(controller.signal, wanted, onRead);
    if (source.kind !== "demo") spoken.value = `${name} opened as model ${side}.`;
    return slot;
  } catch (thrown) {
    if (!wasAborted(thrown)) report(side, thrown);
    return null;
  } finally {
    end(side, controller);
  }
}

type OnRead = (bytes: number, of: number) => void;

async function openWanted(signal: AbortSignal, wanted: Wanted, onRead: OnRead): Promise<Slot> {
  const { source, part, scale } = wanted;
  const client = engineClient();
  let opened: OpenedModel;
  let bytes: number | null = null;
  if (source.kind === "demo") {
    const file = packagedFile(source.name);
    const packaged = file === null ? null : await (await fetched(signal, file)).arrayBuffer();
    opened = await client.openDemo(signal, source.name, packaged);
  } else {
    const files = source.kind === "files" ? source.files : [await download(signal, source.url)];
    bytes = files.reduce((sum, { blob }) => sum + blob.size, 0);
    opened = await client.open(signal, files, part, scale, onRead);
  }
  const geometry = await client.geometry(signal, opened.model);
  const { format, parts, model, report, origin, hasMap } = opened;
  return {
    source,
    scale,
    bytes,
    geometry,
    format,
    parts,
    model,
    part: opened.part,
    report,
    origin,
    hasMap,
  };
}

async function download(signal: AbortSignal, url: string): Promise<DroppedFile> {
  return { name: nameOf({ kind: "url", url }), blob: await (await fetched(signal, url)).blob() };
}

async function fetched(signal: AbortSignal, address: string): Promise<Response> {
  const url = rawAddress(address);
  const failure = (what: string) =>
    new EngineFailure({
      code: "download",
      message: `${url} cannot be downloaded: ${what}.`,
      hint: "Check the address; its server must allow other sites to read it (CORS).",
    });
  const response = await fetch(url, { signal }).catch((thrown: unknown) => {
    signal.throwIfAborted();
    throw failure(thrown instanceof Error ? thrown.message : "no answer");
  });
  if (!response.ok) throw failure(`the server answered ${response.status}`);
  return response;
}

/** A link to a file's page on GitHub means the file. */
function rawAddress(address: string): string {
  return address.replace(
    /^https:\/\/github\.com\/([^/]+)\/([^/]+)\/blob\//,
    "https://raw.githubusercontent.com/$1/$2/",
  );
}

export function nameOf(source: Source): string {
  if (source.kind !== "url") return source.name;
  return decodeURIComponent(source.url.split(/[?#]/)[0]?.split("/").pop() ?? source.url);
}

function baseName(path: string): string {
  return path.split("/").pop() ?? path;
}

async function reopen(): Promise<void> {
  const again = (side: Side) => {
    const slot = slots[side].value;
    return slot ? load(side, { source: slot.source, part: slot.part, scale: slot.scale }) : null;
  };
  const [a, b] = await Promise.all([again("a"), again("b")]);
  batch(() => {
    // The old handles died with the old worker: nothing is to be closed, and what is done to the
    // models stays.
    if (a) slots.a.value = a;
    if (b) slots.b.value = b;
  });
}

onEngineRestart(() => void reopen());
