/**
 * A viewer of its own for pictures that are taken away: drawing them at their size would make the
 * stage draw itself anew after each, dozens of times for an animation.
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

/** Lets go of its memory, and of its WebGL context, of which a page may have only a few. */
export function closeOffscreen(): void {
  open?.viewer.then(
    (viewer) => viewer.dispose(),
    () => undefined,
  );
  open = null;
}
