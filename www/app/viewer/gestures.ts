/** Changes the camera by pointer, wheel and keyboard on the canvas. */
import { type Camera, HOME, orbit, shift, zoomBy } from "../state/camera";

const TURN_PER_PX = 0.009;
const KEY_TURN = 0.12;
const KEY_ZOOM = 1.15;

export interface GestureTarget {
  camera(): Camera;
  setCamera(camera: Camera): void;
  /** Whether shapes are 2-D: dragging shifts them instead of turning. */
  flat(): boolean;
  /** Whether the wheel zooms instead of scrolling the page. */
  ownsWheel(): boolean;
  /** CSS pixels per radius of the shape. */
  pixelsPerRadius(): number;
  hover(x: number, y: number): void;
  leave(): void;
  /** Called for a click without a drag. */
  tap(x: number, y: number): void;
  /** Whether a drag paints instead of turning; two fingers and the right button still turn. */
  paints(at?: { x: number; y: number }): boolean;
  beginStroke(): void;
  endStroke?(): void;
  dropStroke(): void;
  paint(x: number, y: number): void;
}

export function listen(canvas: HTMLCanvasElement, target: GestureTarget): () => void {
  const held = new Map<number, { x: number; y: number }>();
  let moved = 0;
  let painting = false;
  const stop = new AbortController();
  const on = <K extends keyof HTMLElementEventMap>(
    name: K,
    handle: (event: HTMLElementEventMap[K]) => void,
    passive = true,
  ) => canvas.addEventListener(name, handle, { signal: stop.signal, passive });

  const drag = (dx: number, dy: number, shifting: boolean) => {
    const camera = target.camera();
    const scale = 1 / (target.pixelsPerRadius() * camera.zoom);
    target.setCamera(
      shifting || target.flat()
        ? shift(camera, -dx * scale, dy * scale)
        : orbit(camera, -dx * TURN_PER_PX, dy * TURN_PER_PX),
    );
  };

  on("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (held.size === 1) moved = 0;
    // With a second finger the gesture turns or zooms: the stroke of the first one is undone.
    if (painting) target.dropStroke();
    const at = { x: event.offsetX, y: event.offsetY };
    painting = held.size === 1 && event.button === 0 && target.paints(at);
    target.leave();
    if (!painting) return;
    target.beginStroke();
    target.paint(event.offsetX, event.offsetY);
  });
  on("pointermove", (event) => {
    const last = held.get(event.pointerId);
    if (!last) return target.hover(event.offsetX, event.offsetY);
    const [dx, dy] = [event.clientX - last.x, event.clientY - last.y];
    moved += Math.abs(dx) + Math.abs(dy);
    const before = spread(held);
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (held.size === 2) {
      const factor = spread(held) / Math.max(before, 1);
      target.setCamera(zoomBy(target.camera(), factor));
      drag(dx / 2, dy / 2, true);
    } else if (painting) {
      target.paint(event.offsetX, event.offsetY);
    } else {
      // While the left button paints, the right button turns.
      drag(dx, dy, event.shiftKey || (event.buttons === 2 && !target.paints()));
    }
  });
  const release = (event: PointerEvent) => {
    const tapped = held.delete(event.pointerId) && held.size === 0 && moved < 5 && !painting;
    if (painting) target.endStroke?.();
    painting = false;
    if (tapped && event.type === "pointerup" && event.button === 0) {
      target.tap(event.offsetX, event.offsetY);
    }
  };
  on("pointerup", release);
  on("pointercancel", release);
  on("pointerleave", () => target.leave());
  on("contextmenu", (event) => event.preventDefault(), false);
  on(
    "wheel",
    (event) => {
      if (!event.ctrlKey && !target.ownsWheel()) return;
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      const speed = event.ctrlKey ? 0.01 : 0.0015;
      target.setCamera(zoomBy(target.camera(), Math.exp(-event.deltaY * lines * speed)));
    },
    false,
  );
  on(
    "keydown",
    (event) => {
      if (event.key === " " && target.paints()) {
        event.preventDefault();
        target.beginStroke();
        target.paint(canvas.clientWidth / 2, canvas.clientHeight / 2);
        return;
      }
      const next = keyed(event, target);
      if (!next) return;
      event.preventDefault();
      target.setCamera(next);
    },
    false,
  );
  return () => stop.abort();
}

function keyed(event: KeyboardEvent, target: GestureTarget): Camera | null {
  if (event.ctrlKey || event.metaKey || event.altKey) return null;
  const camera = target.camera();
  const move = (x: number, y: number) =>
    target.flat() || event.shiftKey
      ? shift(camera, (0.1 * x) / camera.zoom, (0.1 * y) / camera.zoom)
      : orbit(camera, x * KEY_TURN, y * KEY_TURN);
  switch (event.key) {
    case "ArrowLeft":
      return move(-1, 0);
    case "ArrowRight":
      return move(1, 0);
    case "ArrowUp":
      return move(0, 1);
    case "ArrowDown":
      return move(0, -1);
    case "+":
    case "=":
      return zoomBy(camera, KEY_ZOOM);
    case "-":
    case "_":
      return zoomBy(camera, 1 / KEY_ZOOM);
    case "0":
      return HOME;
    default:
      return null;
  }
}

function spread(held: Map<number, { x: number; y: number }>): number {
  const [one, other] = [...held.values()];
  return one && other ? Math.hypot(one.x - other.x, one.y - other.y) : 1;
}
