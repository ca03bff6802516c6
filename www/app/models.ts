/** Opening models into the two slots. A model that cannot be opened leaves the former one. */
import { batch } from "@preact/signals";
import { EngineFailure, wasAborted } from "../worker/engine-errors";
import type { OpenedPart } from "../worker/protocol";
import { type Demo, packagedFile } from "./demos";
import { engineClient, onEngineRestart, report } from "./engine";
import {
  demo,
  dismiss,
  emptyRegions,
  lockedRange,
  opening,
  SIDES,
  type Side,
  type Slot,
  type Source,
  settings,
  slots,
  spoken,
} from "./state";

const loads: Record<Side, AbortController | null> = { a: null, b: null };
let fileSerial = 0;

export function fileSource(file: File): Source {
  fileSerial += 1;
  return { kind: "file", file, serial: fileSerial };
}

/** A demo that an address asks for, with whatever settings. */
export async function openDemo(demo: Demo): Promise<void> {
  await openPair({ kind: "demo", name: demo.a }, { kind: "demo", name: demo.b });
}

/** A demo that a visitor chooses, with the σ that suits it. */
export async function chooseDemo(demo: Demo): Promise<void> {
  const source = (name: string): Source => ({ kind: "demo", name });
  await openPair(source(demo.a), source(demo.b), demo.sigma ?? null);
}

/** Both change at once, so that no comparison of an old with a new one begins between. */
export async function openPair(a: Source, b: Source, sigma?: number | null): Promise<void> {
  const opened = await Promise.all([load("a", a, null), load("b", b, null)]);
  show({ a: opened[0], b: opened[1] }, sigma);
}

async function openInto(side: Side, source: Source, sigma?: null): Promise<void> {
  const opened = await load(side, source, null);
  show(side === "a" ? { a: opened, b: null } : { a: null, b: opened }, sigma);
}

/** Files that were dropped or chosen: one fills the slot it was meant for, two fill both. */
export async function openFiles(files: File[], side: Side): Promise<void> {
  const [first, second, ...rest] = files;
  if (!first) return;
  if (rest.length > 0) {
    report(
      "page",
      new EngineFailure({
        code: "too-many-files",
        message: `${files.length} files were dropped; one or two were expected.`,
        hint: "Drop one file on a half, or two at once to fill both.",
      }),
    );
    return;
  }
  dismiss("page");
  if (second) await openPair(fileSource(first), fileSource(second), null);
  // Whoever compares several models with one of their own keeps the σ they chose.
  else await openInto(side, fileSource(first), demo.peek() === null ? undefined : null);
}

export async function choosePart(side: Side, index: number): Promise<void> {
  const slot = slots[side].value;
  const part = slot?.parts[index];
  if (!slot || !part || index === slot.chosen) return;
  const geometry = await geometryOf(new AbortController().signal, part);
  slots[side].value = { ...slot, chosen: index, geometry };
}

/** `sigma` where the lengths in use, those of the former models, say nothing of these. */
function show(opened: Record<Side, Slot | null>, sigma?: number | null): void {
  batch(() => {
    if (sigma !== undefined && (opened.a || opened.b)) {
      settings.value = { ...settings.value, sigma, noise: null, differenceThreshold: null };
    }
    for (const side of SIDES) {
      const slot = opened[side];
      if (!slot) continue;
      for (const part of slots[side].value?.parts ?? []) engineClient().close(part.model);
      slots[side].value = slot;
      opening[side].value = null;
    }
    emptyRegions.value = {};
    lockedRange.value = null;
    dismiss("run");
  });
}

/** Null if it failed or another was asked for meanwhile. */
async function load(side: Side, source: Source, chosen: number | null): Promise<Slot | null> {
  loads[side]?.abort();
  const controller = new AbortController();
  loads[side] = controller;
  opening[side].value = nameOf(source);
  dismiss(side);
  try {
    const slot = await openSource(controller.signal, source, chosen);
    if (source.kind !== "demo") spoken.value = `${nameOf(source)} opened as model ${side}.`;
    return slot;
  } catch (thrown) {
    if (!wasAborted(thrown)) report(side, thrown);
    return null;
  } finally {
    if (loads[side] === controller) {
      loads[side] = null;
      opening[side].value = null;
    }
  }
}

async function openSource(
  signal: AbortSignal,
  source: Source,
  chosen: number | null,
): Promise<Slot> {
  const client = engineClient();
  let bytes: ArrayBuffer | null;
  let size: number | null = null;
  if (source.kind === "demo") {
    const file = packagedFile(source.name);
    bytes = file === null ? null : await fetched(signal, file);
  } else {
    bytes =
      source.kind === "file" ? await readFile(source.file) : await fetched(signal, source.url);
    size = bytes.byteLength;
  }
  const opened =
    source.kind === "demo"
      ? await client.openDemo(signal, source.name, bytes)
      : await client.open(signal, nameOf(source), bytes ?? new ArrayBuffer(0));
  const index =
    chosen ??
    Math.max(
      0,
      opened.parts.findIndex((part) => part.report.kind === "shape"),
    );
  const part = opened.parts[index];
  if (!part) {
    throw new EngineFailure({
      code: "empty-file",
      message: `“${nameOf(source)}” holds no shape model.`,
      hint: "Open a file with a mean shape and its modes.",
    });
  }
  const geometry = await geometryOf(signal, part);
  return {
    source,
    format: opened.format,
    bytes: size,
    parts: opened.parts,
    chosen: index,
    geometry,
  };
}

function geometryOf(signal: AbortSignal, part: OpenedPart) {
  return engineClient().geometry(signal, part.model);
}

async function readFile(file: File): Promise<ArrayBuffer> {
  try {
    return await file.arrayBuffer();
  } catch {
    throw new EngineFailure({
      code: "unreadable-file",
      message: `“${file.name}” cannot be read.`,
      hint: "If it was moved, changed or is a folder, choose the file again.",
    });
  }
}

async function fetched(signal: AbortSignal, address: string): Promise<ArrayBuffer> {
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
  return response.arrayBuffer();
}

/** A link to a file's page on GitHub means the file. */
function rawAddress(address: string): string {
  return address.replace(
    /^https:\/\/github\.com\/([^/]+)\/([^/]+)\/blob\//,
    "https://raw.githubusercontent.com/$1/$2/",
  );
}

export function nameOf(source: Source): string {
  if (source.kind === "demo") return source.name;
  if (source.kind === "file") return source.file.name;
  return decodeURIComponent(source.url.split(/[?#]/)[0]?.split("/").pop() ?? source.url);
}

async function reopen(): Promise<void> {
  const held = { a: slots.a.value, b: slots.b.value };
  const again = (side: Side) => {
    const slot = held[side];
    return slot ? load(side, slot.source, slot.chosen) : null;
  };
  const [a, b] = await Promise.all([again("a"), again("b")]);
  for (const [side, slot] of [
    ["a", a],
    ["b", b],
  ] as const) {
    // The old handles died with the old worker: nothing is to be closed.
    if (slot) slots[side].value = slot;
  }
}

onEngineRestart(() => void reopen());
