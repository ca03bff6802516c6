import type { ComponentChildren } from "preact";
import { useEffect, useLayoutEffect, useRef } from "preact/hooks";
import { isDark } from "../../state/theme";
import { type Palette, paletteOf } from "./palette";

export interface Size {
  width: number;
  height: number;
}
export interface Pointer {
  x: number;
  y: number;
  size: Size;
}
export type Draw = (pen: CanvasRenderingContext2D, size: Size, palette: Palette) => void;

interface Props {
  /** Description of the picture for screen readers. */
  label: string;
  /** Height over width. */
  aspect: number;
  /** Draws everything, in CSS pixels; called whenever the component is rendered. */
  draw: Draw;
  /**
   * Called when a drag begins; false lets the page scroll instead. With `sideways`, vertical movements of a finger
   * still scroll the page.
   */
  onGrab?: (at: Pointer) => boolean | "sideways";
  onDrag?: (at: Pointer) => void;
  onDrop?: () => void;
  /** Handles a key; returns whether it did. */
  onKey?: (key: string, event: KeyboardEvent) => boolean;
  /** Id of the element that explains its keys. */
  help?: string;
  children?: ComponentChildren;
}

/** Pixels after which a horizontal drag of a finger is recognised. */
const SURE = 8;

/** Canvas of a lesson: handles resolution, theme, dragging and keys; a function draws on it. */
export function LessonCanvas(props: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const latest = useRef(props);
  latest.current = props;
  const held = useRef<boolean | "sideways">(false);
  /** Start of a touch that may still become a scroll. */
  const undecided = useRef<Pointer | null>(null);
  const { label, aspect, onGrab, onKey, help } = props;
  const dark = isDark();
  useLayoutEffect(() => paint(canvas.current, latest.current.draw));
  useEffect(() => {
    const element = canvas.current;
    if (!element) return;
    const observer = new ResizeObserver(() => paint(element, latest.current.draw));
    observer.observe(element);
    // A touch on something draggable drags it, any other one scrolls the page. Browsers decide this at `touchstart`,
    // which follows `pointerdown` and which Preact would listen to passively.
    const hold = (event: TouchEvent) => {
      if (held.current === true) event.preventDefault();
    };
    element.addEventListener("touchstart", hold, { passive: false });
    return () => {
      observer.disconnect();
      element.removeEventListener("touchstart", hold);
    };
  }, []);
  const at = (event: PointerEvent): Pointer => {
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    return { x, y, size: { width: box.width, height: box.height } };
  };
  const down = (event: PointerEvent) => {
    held.current = event.button === 0 && (latest.current.onGrab?.(at(event)) ?? false);
    if (!held.current) return;
    undecided.current =
      held.current === "sideways" && event.pointerType === "touch" ? at(event) : null;
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    event.preventDefault();
    // Focus for the arrow keys; not for touch, which needs no focus ring.
    if (event.pointerType !== "touch") {
      (event.currentTarget as HTMLElement).focus({ preventScroll: true });
    }
  };
  const move = (event: PointerEvent) => {
    if (!held.current) return;
    const now = at(event);
    const { current: down } = undecided;
    const [dx, dy] = down ? [Math.abs(now.x - down.x), Math.abs(now.y - down.y)] : [SURE, 0];
    if (dx < SURE || dx < dy) return;
    undecided.current = null;
    latest.current.onDrag?.(now);
  };
  const up = (event: PointerEvent) => {
    if (!held.current) return;
    // A fast drag may have no move event before the release.
    if (event.type === "pointerup") move(event);
    held.current = false;
    latest.current.onDrop?.();
  };
  return (
    <div class="board" style={{ aspectRatio: String(1 / aspect) }} data-dark={dark}>
      <canvas
        ref={canvas}
        // Arrow keys move something instead of scrolling.
        role={onKey ? "application" : "img"}
        tabIndex={onKey ? 0 : -1}
        aria-label={label}
        aria-describedby={help}
        data-drags={onGrab !== undefined}
        onPointerDown={down}
        onPointerMove={move}
        onPointerUp={up}
        onPointerCancel={up}
        onKeyDown={(event) => {
          if (onKey?.(event.key, event)) {
            event.preventDefault();
            event.stopPropagation();
          }
        }}
      />
      {props.children}
    </div>
  );
}

function paint(canvas: HTMLCanvasElement | null, draw: Draw): void {
  const pen = canvas?.getContext("2d");
  if (!canvas || !pen) return;
  const size = { width: canvas.clientWidth, height: canvas.clientHeight };
  if (size.width === 0) return;
  const scale = Math.min(devicePixelRatio, 2);
  const [width, height] = [Math.round(size.width * scale), Math.round(size.height * scale)];
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.clearRect(0, 0, size.width, size.height);
  pen.lineJoin = pen.lineCap = "round";
  draw(pen, size, paletteOf(canvas));
}
