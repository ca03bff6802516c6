/** Saves files to the visitor's computer and copies text. */
import type { Download } from "../../worker/protocol";
import { engineClient, report } from "../state/engine";
import { dismiss } from "../state/state";

export async function download(what: Download): Promise<void> {
  try {
    const { name, mime, bytes } = await engineClient().export(new AbortController().signal, what);
    dismiss("page");
    saveBlob(name, new Blob([bytes], { type: mime }));
  } catch (thrown) {
    report("page", thrown);
  }
}

export function saveText(name: string, text: string, type = "application/json"): void {
  saveBlob(name, new Blob([text], { type }));
}

export function saveBlob(name: string, blob: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  // Some browsers begin to read only after the click.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

/** Copies a text; resolves to whether the browser allowed it. */
export async function copyText(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}
