/** The sources of models (examples, files, addresses), and how a model is opened from one. */
import { EngineFailure } from "../../worker/engine-errors";
import type { DroppedFile, OpenedModel } from "../../worker/protocol";
import { packagedFile } from "../state/demos";
import { engineClient } from "../state/engine";
import {
  type Files,
  type ReadProgress,
  type Slot,
  type Source,
  slotKey,
  type Wanted,
} from "../state/state";
import { fileName } from "./address/address";
import { fetchModel } from "./address/fetching";
import { wordOf } from "./reading";

export interface NamedSource {
  name: string;
  source: Files;
}

let fileSerial = 0;

/** The first model of a source, as its file says. */
export function first(source: Source): Wanted {
  return { source, part: null, reading: "" };
}

export function demoSource(name: string): Source {
  return { kind: "demo", name };
}

export function filesSource(name: string, files: DroppedFile[], leftOut: string[] = []): Files {
  fileSerial += 1;
  return { kind: "files", name, files, serial: fileSerial, leftOut };
}

/** Most names in a sentence. */
const NAMED = 5;

/** Which dropped files are no part of a population. */
function leftOutSentence(names: string[]): string {
  const more = names.length > NAMED ? ` and ${names.length - NAMED} more` : "";
  return `Left out, since they are no shapes of the set: ${names.slice(0, NAMED).join(", ")}${more}.`;
}

/** Source, part and shapes with which this model can be opened again. */
export function wantedOf({ source, part, reading, shapes = null }: Wanted): Wanted {
  return { source, part, reading, shapes };
}

/** Whether an open model is the wanted one. */
export function isOpen(slot: Slot, wanted: Wanted): boolean {
  const { source, reading, shapes = null } = wanted;
  const part = wanted.part ?? slot.parts[0] ?? "";
  return slotKey(slot) === slotKey({ ...slot, source, reading, shapes, part });
}

export function nameOf(source: Source): string {
  return source.kind === "url" ? fileName(source.url) : source.name;
}

/** What a model is called: its file or set, or its group of a set. */
export function titleOf({ source, reading, report }: Slot): string {
  return wordOf(reading, "group") === null ? nameOf(source) : report.name;
}

export function baseName(path: string): string {
  return path.split("/").pop() ?? path;
}

/** The source as a run file states it; null for the visitor's own files. */
export function sourceText(source: Source): string | null {
  if (source.kind === "demo") return `demo:${source.name}`;
  return source.kind === "url" ? source.url : null;
}

export type OnRead = (read: ReadProgress) => void;

/** Opens a model without its geometry, which only A and B need. */
export async function openWanted(
  signal: AbortSignal,
  wanted: Wanted,
  onRead: OnRead,
): Promise<Slot> {
  const { source, part, reading, shapes = null } = wanted;
  const client = engineClient();
  let opened: OpenedModel;
  let bytes: number | null = null;
  if (source.kind === "demo") {
    const file = packagedFile(source.name);
    const packaged = file === null ? null : await packagedBytes(signal, file);
    opened = await client.openDemo(signal, source.name, packaged);
  } else {
    const arrive = (bytes: number, of: number | null) => onRead({ bytes, of, arrives: true });
    const files =
      source.kind === "files" ? source.files : [await fetchModel(signal, source.url, arrive)];
    bytes = files.reduce((sum, { blob }) => sum + blob.size, 0);
    opened = await client.open(signal, files, part, reading, (bytes, of) => onRead({ bytes, of }));
  }
  if (shapes) opened = await withShapes(signal, opened, shapes, reading);
  const { format, parts, model, origin, hasMap } = opened;
  const leftOut = source.kind === "files" ? (source.leftOut ?? []) : [];
  const said = leftOut.length > 0 ? [leftOutSentence(leftOut)] : [];
  const report = { ...opened.report, notes: [...opened.report.notes, ...said] };
  return {
    source,
    reading,
    shapes,
    bytes,
    geometry: null,
    format,
    parts,
    model,
    part: opened.part,
    report,
    origin,
    hasMap,
  };
}

/** The model with its shapes; closed if they do not fit. */
async function withShapes(
  signal: AbortSignal,
  { model }: OpenedModel,
  { files, name }: Files,
  reading: string,
): Promise<OpenedModel> {
  try {
    return await engineClient().addShapes(signal, model, files, name, reading);
  } catch (thrown) {
    engineClient().close(model);
    throw thrown;
  }
}

async function packagedBytes(signal: AbortSignal, file: string): Promise<ArrayBuffer> {
  const response = await fetch(file, { signal }).catch(() => null);
  signal.throwIfAborted();
  if (response?.ok) return response.arrayBuffer();
  throw new EngineFailure({
    code: "download",
    message: `${file}, which comes with the page, cannot be loaded: ${response ? `the server answered ${response.status}` : "there was no answer"}.`,
    hint: "Check the connection and load the page again.",
  });
}
