/** Where models come from, and how one of them is opened. */
import { EngineFailure } from "../worker/engine-errors";
import type { DroppedFile, OpenedModel } from "../worker/protocol";
import { packagedFile } from "./demos";
import { engineClient } from "./engine";
import { type Slot, type Source, slotKey, type Wanted } from "./state";

export interface NamedSource {
  name: string;
  source: Source;
}

let fileSerial = 0;

/** The first model of a source, as it is. */
export function first(source: Source): Wanted {
  return { source, part: null, scale: false };
}

export function demoSource(name: string): Source {
  return { kind: "demo", name };
}

export function filesSource(name: string, files: DroppedFile[]): Source {
  fileSerial += 1;
  return { kind: "files", name, files, serial: fileSerial };
}

/** What would open this model again. */
export function wantedOf({ source, part, scale }: Wanted): Wanted {
  return { source, part, scale };
}

/** Whether an open model is the one that is wanted. */
export function isOpen(slot: Slot, wanted: Wanted): boolean {
  return (
    slotKey(slot) === slotKey({ ...slot, ...wanted, part: wanted.part ?? slot.parts[0] ?? "" })
  );
}

export function nameOf(source: Source): string {
  if (source.kind !== "url") return source.name;
  return decodeURIComponent(source.url.split(/[?#]/)[0]?.split("/").pop() ?? source.url);
}

export function baseName(path: string): string {
  return path.split("/").pop() ?? path;
}

/** As a run file names it: of a file of one's own, nothing. */
export function sourceText(source: Source): string | null {
  if (source.kind === "demo") return `demo:${source.name}`;
  return source.kind === "url" ? source.url : null;
}

type OnRead = (bytes: number, of: number) => void;

/** Without its geometry, which only the two that are compared need. */
export async function openWanted(
  signal: AbortSignal,
  wanted: Wanted,
  onRead: OnRead,
): Promise<Slot> {
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
  const { format, parts, model, report, origin, hasMap } = opened;
  return {
    source,
    scale,
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
