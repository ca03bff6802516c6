/**
 * Viewer for figures and animations, separate from that of the page: drawing them with the page's viewer would
 * redraw the page after each frame.
 */
import { createViewer, dimension } from "../stage/stage-controller";
import type { Viewer } from "../viewer/viewer";

let open: { flat: boolean; viewer: Promise<Viewer> } | null = null;

export function offscreenViewer(): Promise<Viewer> {
  const flat = dimension.peek() === 2;
  if (open && open.flat !== flat) closeOffscreen();
  open ??= { flat, viewer: createViewer(document.createElement("canvas"), flat) };
  return open.viewer;
}

/** Frees the memory and the WebGL context of the viewer; a page may have only a few contexts. */
export function closeOffscreen(): void {
  open?.viewer.then(
    (viewer) => viewer.dispose(),
    () => undefined,
  );
  open = null;
}
