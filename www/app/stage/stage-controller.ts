/** Keeps a viewer in step with the state: which one, what it shows, and how it is turned. */
import { computed, effect, signal } from "@preact/signals";
import type { Region } from "../../worker/protocol";
import { beginStroke, brushRadius, paintAt, undoStroke } from "../models/painting";
import {
  alone,
  camera,
  compared,
  embedded,
  packagedHeads,
  painting,
  region,
  type Side,
  shapes,
  slots,
  tab,
  vertex,
  view,
} from "../state/state";
import { isDark } from "../state/theme";
import { REGIONS } from "../state/view";
import {
  cardContent,
  contentsOf,
  dimensionOf,
  markedContent,
  type Scene,
  sceneFrame,
} from "../viewer/contents";
import { listen } from "../viewer/gestures";
import { type Hit, halfHeightIn, type Rect, type Viewer } from "../viewer/viewer";
import { ellipsoids, mapRange, type ShownMap, shownMap } from "./maps";

/** What is under the pointer, with its place on the canvas. */
export const hover = signal<(Hit & { x: number; y: number }) | null>(null);
/** The brush under the pointer: its place on the canvas and its radius there. */
export const brush = signal<{ x: number; y: number; radius: number } | null>(null);
/** Set while a viewer is there, for pictures. */
export const viewer = signal<Viewer | null>(null);
/** Whether a card can have its picture drawn. */
export const drawable = signal(false);

export const scene = computed<Scene>(() => ({
  geometry: { a: slots.a.value?.geometry ?? null, b: slots.b.value?.geometry ?? null },
  compared: compared.value,
  shapes: shapes.value,
  mode: view.value,
  dark: isDark(),
  fadeRim: packagedHeads.value,
  map: mapOf(shownMap.value),
  ellipsoids: tab.value === "regions" ? ellipsoids.value : {},
}));

/** Standard deviations come with what is drawn, before and after there is a comparison. */
function mapOf({ name, values, palette }: ShownMap): Scene["map"] {
  return name === "sd" ? undefined : { values, palette };
}

export const dimension = computed(() => dimensionOf(scene.value));

const regionsShown = computed<readonly Region[]>(() =>
  alone.value === null ? REGIONS : [alone.value],
);

/** What is painted on: the mean of A, and nothing else. */
const canvasOfPaint = computed<Scene>(() => ({
  ...scene.value,
  compared: null,
  shapes: {},
  mode: "mean",
  geometry: { a: scene.value.geometry.a, b: null },
}));
const paintFrame = computed(() => sceneFrame(canvasOfPaint.value));

/** The range of colours; null where shapes are drawn in plain ones. */
export const range = computed(() => (view.value === "sd" ? mapRange.value : null));

/** Whether a click chooses a vertex instead of a region. */
export const picking = signal(false);

let panes = new Map<Region, HTMLElement>();

/** Takes over a canvas; returns how to let go of it. */
export function takeCanvas(
  canvas: HTMLCanvasElement,
  elements: Map<Region, HTMLElement>,
): () => void {
  panes = elements;
  const stops: (() => void)[] = [];
  let gone = false;
  const flat = dimension.peek() === 2;
  void createViewer(canvas, flat).then((made) => {
    if (gone) return made.dispose();
    viewer.value = made;
    stops.push(
      effect(() => {
        // Shapes of another dimension wait for the viewer that replaces this one.
        if ((dimension.value === 2) !== flat) return;
        if (painting.value) {
          const content = markedContent(canvasOfPaint.value, painting.value.mask);
          made.setMesh(content ? [content] : [], paintFrame.value);
          return;
        }
        brush.value = null;
        made.setMesh(contentsOf(scene.value, regionsShown.value), sceneFrame(scene.value));
      }),
      effect(() => made.setColors(range.value)),
      effect(() => made.setCamera(camera.value)),
    );
    const lay = () => {
      made.setLayout(...layoutOf(canvas));
      drawable.value = true;
    };
    const observer = new ResizeObserver(lay);
    observer.observe(canvas);
    for (const pane of panes.values()) observer.observe(pane);
    stops.push(
      effect(() => {
        regionsShown.value;
        requestAnimationFrame(lay);
      }),
      () => observer.disconnect(),
    );
    stops.push(listen(canvas, gestures(canvas, made)));
  });
  return () => {
    gone = true;
    for (const stop of stops) stop();
    viewer.peek()?.dispose();
    viewer.value = null;
    drawable.value = false;
    hover.value = null;
  };
}

const viewers = {
  flat: () => import("../viewer/flat-viewer"),
  space: () => import("../viewer/mesh-viewer"),
};

export async function createViewer(canvas: HTMLCanvasElement, flat: boolean): Promise<Viewer> {
  const made = flat
    ? new (await viewers.flat()).FlatViewer(canvas)
    : new (await viewers.space()).MeshViewer(canvas);
  // The other one too: without a network the page still draws whatever is opened.
  viewers[flat ? "space" : "flat"]().catch(() => undefined);
  return made;
}

function gestures(canvas: HTMLCanvasElement, made: Viewer) {
  const wide = matchMedia("(min-width: 1100px)");
  const paints = () => painting.peek() !== null && painting.peek()?.tool !== "turn";
  const paint = (x: number, y: number) => {
    const hit = made.pick(x, y);
    if (hit) paintAt(hit.vertex);
    showBrush(canvas, x, y);
  };
  return {
    paints,
    beginStroke,
    dropStroke: undoStroke,
    paint,
    camera: () => camera.peek(),
    setCamera: (next: typeof camera.value) => {
      camera.value = next;
    },
    flat: () => dimension.peek() === 2,
    // A frame scrolls with the page around it.
    ownsWheel: () => !embedded.peek() && (wide.matches || alone.peek() !== null),
    pixelsPerRadius: () => {
      const pane = panes.get(alone.peek() ?? "intersection");
      return Math.max(40, (pane?.clientHeight ?? 200) / 2.2);
    },
    hover: (x: number, y: number) => {
      if (paints()) return showBrush(canvas, x, y);
      const hit = made.pick(x, y);
      hover.value = hit && { ...hit, x, y };
      canvas.style.cursor = picking.peek() ? "crosshair" : "";
    },
    leave: () => {
      hover.value = null;
      brush.value = null;
    },
    tap: (x: number, y: number) => {
      if (picking.peek()) {
        const hit = made.pick(x, y);
        if (hit) vertex.value = hit.vertex;
        return;
      }
      if (alone.peek() !== null) return;
      for (const [name, rect] of layoutOf(canvas)[2]) {
        const inside =
          x >= rect.x && y >= rect.y && x < rect.x + rect.width && y < rect.y + rect.height;
        if (inside) region.value = name;
      }
    },
  };
}

/** As wide as the brush is on a surface that faces the eye. */
function showBrush(canvas: HTMLCanvasElement, x: number, y: number): void {
  const rect = layoutOf(canvas)[2].get("a");
  if (!rect) return;
  const halfHeight = halfHeightIn(rect, paintFrame.peek()) / camera.peek().zoom;
  brush.value = { x, y, radius: (brushRadius() * rect.height) / (2 * halfHeight) };
}

export function layoutOf(
  canvas: HTMLCanvasElement,
  elements = panes,
): [number, number, Map<Region, Rect>] {
  const whole = canvas.getBoundingClientRect();
  const rects = new Map<Region, Rect>();
  for (const [name, pane] of elements) {
    const rect = pane.getBoundingClientRect();
    if (rect.width === 0) continue;
    rects.set(name, {
      x: rect.x - whole.x,
      y: rect.y - whole.y,
      width: rect.width,
      height: rect.height,
    });
  }
  return [whole.width, whole.height, rects];
}

/** A picture of one model for its card; null until there is something to draw with. */
export function cardPicture(side: Side, size: number): HTMLCanvasElement | null {
  const geometry = slots[side].value?.geometry;
  const made = viewer.value;
  if (!geometry || !made || geometry.dimension !== dimension.peek()) return null;
  const content = cardContent(geometry, side, scene.peek());
  if (!content) return null;
  const one: Scene = {
    ...scene.peek(),
    compared: null,
    shapes: {},
    mode: "mean",
    geometry: { a: geometry, b: null },
  };
  return made.thumbnail(content, sceneFrame(one), size);
}
