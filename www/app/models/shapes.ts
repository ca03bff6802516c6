/** Recognises shapes that are given beside a model. Pure. */
import type { DroppedFile } from "../../worker/protocol";
import type { Files, Slot } from "../state/state";

const SHAPE_FILE =
  /\.(ply|obj|off|stl|vtk|vtp|tps|particles|pts|pp|asf|fcsv|mrk\.json|landmarkAscii)$/i;

/** Whether these files are several shapes, dropped where a model that was made elsewhere is open. */
export function mayBeShapesOf(slot: Slot | null, { files }: Files): boolean {
  if (slot?.source.kind !== "files" || slot.origin.kind !== "file") return false;
  return files.length > 1 && files.every(({ name }) => SHAPE_FILE.test(name));
}

/** What shapes are called: their folder, or the only file. */
export function nameOfShapes(files: DroppedFile[]): string {
  const [first] = files;
  if (!first) return "";
  const folder = first.name.split("/").slice(0, -1)[0];
  return folder ?? (files.length === 1 ? first.name : `${files.length} files`);
}
