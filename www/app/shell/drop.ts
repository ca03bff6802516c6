/** Opens files that are dropped anywhere on the window; a drop never leaves the page. */
import { signal } from "@preact/signals";
import type { DroppedFile, Side } from "../../worker/protocol";
import { openFiles } from "../panels/dropped-files";
import { notify } from "../state/state";
import { count } from "../text/format";
import { filesBelow, filesOf, MOST_FILES } from "../ui/folders";

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
    if (event.dataTransfer && holdsFiles(event)) void take(event.dataTransfer, sideAt(event));
  });
}

async function take(dropped: DataTransfer, side: Side): Promise<void> {
  const files = await droppedFiles(dropped);
  const refuse = (code: string, message: string) =>
    notify(
      "page",
      code,
      message,
      "Drop models, or folders that each hold the shapes of one population.",
    );
  if (files.length === 0) refuse("no-files", "There was no file in the drop.");
  else if (files.length < MOST_FILES) await openFiles(files, side);
  else refuse("too-many-files", `More than ${count(MOST_FILES)} files were dropped.`);
}

/** Reads the entries of a drop at once: the browser clears the list after the event. */
function droppedFiles(dropped: DataTransfer): Promise<DroppedFile[]> {
  const items = [...dropped.items].filter(({ kind }) => kind === "file");
  const entries = items.flatMap((item) => item.webkitGetAsEntry?.() ?? []);
  const folders = entries.length === items.length && entries.some((entry) => entry.isDirectory);
  const plain = filesOf(dropped.files);
  return folders ? filesBelow(entries) : Promise.resolve(plain);
}

function holdsFiles(event: DragEvent): boolean {
  return event.dataTransfer?.types.includes("Files") ?? false;
}

/** The half under the pointer: side by side on wide windows, one above the other on tall ones. */
function sideAt(event: DragEvent): Side {
  const wide = innerWidth >= innerHeight;
  const share = wide ? event.clientX / innerWidth : event.clientY / innerHeight;
  return share < 0.5 ? "a" : "b";
}
