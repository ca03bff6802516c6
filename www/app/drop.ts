/** The whole window takes files, always. A miss never navigates away. */
import { signal } from "@preact/signals";
import { openFiles } from "./models";
import type { Side } from "./state";

/** The half under the dragged files; null while nothing is dragged. */
export const dropSide = signal<Side | null>(null);

export function acceptDrops(): void {
  let depth = 0;
  addEventListener("dragenter", (event) => {
    if (!holdsFiles(event)) return;
    event.preventDefault();
    depth += 1;
    dropSide.value = sideAt(event);
  });
  addEventListener("dragover", (event) => {
    if (!holdsFiles(event)) return;
    event.preventDefault();
    if (event.dataTransfer) event.dataTransfer.dropEffect = "copy";
    dropSide.value = sideAt(event);
  });
  addEventListener("dragleave", () => {
    depth = Math.max(0, depth - 1);
    if (depth === 0) dropSide.value = null;
  });
  addEventListener("drop", (event) => {
    event.preventDefault();
    depth = 0;
    dropSide.value = null;
    const files = [...(event.dataTransfer?.files ?? [])];
    if (files.length > 0) void openFiles(files, sideAt(event));
  });
}

function holdsFiles(event: DragEvent): boolean {
  return event.dataTransfer?.types.includes("Files") ?? false;
}

/** Halves lie side by side on wide windows and over one another on tall ones, as drawn. */
function sideAt(event: DragEvent): Side {
  const wide = innerWidth >= innerHeight;
  const share = wide ? event.clientX / innerWidth : event.clientY / innerHeight;
  return share < 0.5 ? "a" : "b";
}
