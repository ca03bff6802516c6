/**
 * Downloads the file of a model from its address, after asking if it is large, and checks that it is not a web page.
 */
import type { DroppedFile } from "../../../worker/protocol";
import { fileAddress, fileName } from "./address";
import { askFirst, isAllowed, UNASKED_BYTES } from "./consent";
import { brokenOff, otherThanPointer, pointerOnly, refused, unread, webPage } from "./failures";
import { behindPointer, LONGEST_POINTER, type Pointer, pointerIn } from "./lfs";

/** `of` is null if the host does not state the size. */
export type OnArrived = (bytes: number, of: number | null) => void;

export async function fetchModel(
  signal: AbortSignal,
  address: string,
  onArrived: OnArrived,
): Promise<DroppedFile> {
  const url = fileAddress(address, document.baseURI);
  const name = fileName(address);
  const blob = await fetchWhole(signal, url, name, onArrived);
  const pointer = blob.size < LONGEST_POINTER ? pointerIn(await blob.text()) : null;
  if (!pointer) return { name, blob };
  const media = behindPointer(url);
  if (!media) throw pointerOnly(url, pointer);
  const file = await fetchWhole(signal, media, name, onArrived);
  await mustBe(file, pointer, media);
  return { name, blob: file };
}

/** Downloads a file; asks before a large one, also if its size shows only during the download. */
async function fetchWhole(
  signal: AbortSignal,
  url: URL,
  name: string,
  onArrived: OnArrived,
): Promise<Blob> {
  for (;;) {
    const most = isAllowed(url) ? Number.POSITIVE_INFINITY : UNASKED_BYTES;
    const found = await fetchUpTo(most, signal, url, onArrived);
    if (found instanceof Blob) return found;
    // The connection is closed while the page asks, since hosts end connections that are not read.
    await askFirst(signal, url, name, found.bytes);
  }
}

/** The file, or its size if it is larger than `most`. */
async function fetchUpTo(
  most: number,
  signal: AbortSignal,
  url: URL,
  onArrived: OnArrived,
): Promise<Blob | { bytes: number | null }> {
  const giveUp = new AbortController();
  const either = AbortSignal.any([signal, giveUp.signal]);
  const response = await fetch(url, { signal: either, referrerPolicy: "no-referrer" }).catch(() => {
    signal.throwIfAborted();
    throw unread(url, navigator.onLine);
  });
  const stop = <T>(outcome: T): T => {
    giveUp.abort();
    return outcome;
  };
  if (!response.ok || !response.body) throw stop(refused(url, response.status));
  const promised = Number(response.headers.get("content-length") ?? Number.NaN);
  if (promised > most) return stop({ bytes: promised });
  const pieces: Uint8Array<ArrayBuffer>[] = [];
  let arrived = 0;
  // A compressed response is longer than its stated size.
  const of = () => (arrived <= promised ? promised : null);
  const reader = response.body.getReader();
  for (;;) {
    const { done, value } = await reader.read().catch(() => {
      signal.throwIfAborted();
      throw brokenOff(url, arrived, of());
    });
    if (done) return new Blob(pieces);
    if (arrived === 0 && isWebPage(value)) throw stop(webPage(url));
    arrived += value.byteLength;
    if (arrived > most) return stop({ bytes: null });
    pieces.push(value);
    onArrived(arrived, of());
  }
}

/** Whether the content is a web page: the content types of many hosts are wrong. */
function isWebPage(start: Uint8Array): boolean {
  const text = new TextDecoder().decode(start.subarray(0, 512));
  return /^\s*(<!--[^>]*-->\s*)?<(!doctype\s+html|html|head)\b/i.test(text);
}

async function mustBe(file: Blob, { size, sha256 }: Pointer, url: URL): Promise<void> {
  if (file.size !== size) throw otherThanPointer(url, "size", `${size}`, `${file.size}`);
  // Browsers offer no hashes to pages that are not encrypted.
  if (!isSecureContext) return;
  const digest = await crypto.subtle.digest("SHA-256", await file.arrayBuffer());
  const found = [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, "0"));
  if (found.join("") !== sha256) throw otherThanPointer(url, "SHA-256", sha256, found.join(""));
}
