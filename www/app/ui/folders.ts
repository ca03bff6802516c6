/** Lists the files of dropped or chosen folders, each with its path. */
import type { DroppedFile } from "../../worker/protocol";

/** The members of a FileSystemEntry that are used here. */
export interface Entry {
  readonly isFile: boolean;
  readonly isDirectory: boolean;
  readonly name: string;
  readonly fullPath: string;
}
interface FileEntry extends Entry {
  file(done: (file: File) => void, failed: (reason: unknown) => void): void;
}
interface FolderEntry extends Entry {
  createReader(): {
    readEntries(done: (entries: Entry[]) => void, failed: (reason: unknown) => void): void;
  };
}

/** Largest number of files: listing more would take minutes. */
export const MOST_FILES = 20_000;

/** All files below these entries, in the order of their paths; unreadable ones are left out. */
export async function filesBelow(entries: Entry[]): Promise<DroppedFile[]> {
  const found: DroppedFile[] = [];
  const waiting = entries.filter(isMeant);
  while (waiting.length > 0 && found.length < MOST_FILES) {
    const entry = waiting.shift();
    if (entry?.isDirectory) {
      waiting.push(...(await inFolder(entry as FolderEntry)).filter(isMeant));
    } else if (entry) {
      const file = await fileOf(entry as FileEntry);
      if (file) found.push({ name: entry.fullPath.replace(/^\/+/, ""), blob: file });
    }
  }
  return found.sort((one, other) => byName(one.name, other.name));
}

/** The files of an `<input type="file">`, with paths if it is for folders. */
export function filesOf(list: Iterable<File>): DroppedFile[] {
  return [...list]
    .filter(isMeant)
    .map((file) => ({ name: file.webkitRelativePath || file.name, blob: file }));
}

/** Compares paths so that “9.ply” comes before “10.ply”. */
const byName = new Intl.Collator("en", { numeric: true }).compare;

/** Whether an entry is no hidden file of a file manager or archive. */
function isMeant({ name }: { name: string }): boolean {
  return !name.startsWith(".") && name !== "__MACOSX" && name !== "Thumbs.db";
}

function fileOf(entry: FileEntry): Promise<File | null> {
  return new Promise((resolve) => entry.file(resolve, () => resolve(null)));
}

/** Browsers list a folder a hundred entries at a time. */
async function inFolder(entry: FolderEntry): Promise<Entry[]> {
  const reader = entry.createReader();
  const all: Entry[] = [];
  for (;;) {
    const some = await new Promise<Entry[]>((resolve) =>
      reader.readEntries(resolve, () => resolve([])),
    );
    if (some.length === 0) return all;
    all.push(...some);
  }
}
