/** Updates the viewer of the five regions when shapes, colours, camera or selection change. */
import { computed, effect, signal } from "@preact/signals";
import type { Region, Side } from "../../worker/protocol";
import { beginStroke, brushRadius, paintAt, undoStroke } from "../models/painting";
import { HOME } from "../state/camera";
import { REGIONS } from "../state/regions";
import {
  alone,
  camera,
  compared,
  embedded,
  geometry,
  packagedHeads,
  painting,
  region,
  shapes,
  tab,
  vertex,
  view,
} from "../state/state";
import { isDark } from "../state/theme";
import { isColoured } from "../state/view";
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
import { pairedShapes } from "./pairs";

/** The vertex under the pointer and its position on the canvas. */
export const hover = signal<(Hit & { x: number; y: number }) | null>(null);
/** Position and radius of the brush on the canvas. */
export const brush = signal<{ x: number; y: number; radius: number } | null>(null);
/** The viewer while there is one, for figures. */
export const viewer = signal<Viewer | null>(null);
/** Whether the pictures of the model cards can be drawn. */
export const drawable = signal(false);

export const scene = computed<Scene>(() => ({
  geometry: geometry.value,
  compared: compared.value,
  shapes: shapes.value,
  mode: view.value,
  dark: isDark(),
  fadeRim: packagedHeads.value,
  map: mapOf(shownMap.value),
  pairs: pairedShapes.value,
  ellipsoids: tab.value === "regions" ? ellipsoids.value : {},
}));

/** The map to draw; standard deviations come with the shapes themselves. */
export function mapOf({ name, values, palette }: ShownMap): Scene["map"] {
  return name === "sd" ? undefined : { values, palette };
}

export const dimension = computed(() => dimensionOf(scene.value));

const regionsShown = computed<readonly Region[]>(() =>
  alone.value === null ? REGIONS : [alone.value],
);

/** The scene while compared points are painted: the mean of A alone. */
const canvasOfPaint = computed<Scene>(() => ({
  ...scene.value,
  compared: null,
  shapes: {},
  mode: "mean",
  geometry: { a: scene.value.geometry.a, b: null },
}));
const paintFrame = computed(() => sceneFrame(canvasOfPaint.value));

/** The range of the colours; null if shapes are drawn without a map. */
export const range = computed(() => (isColoured(view.value) ? mapRange.value : null));

/** Whether a click chooses a vertex instead of a region. */
export const picking = signal(false);

let panes = new Map<Region, HTMLElement>();

/** Draws on a canvas; returns a function that ends it. */
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
        // Shapes of another dimension are drawn by the viewer that replaces this one.
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
  // Both viewers are loaded, so that the page can draw flat and spatial models without a network.
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
    // In a frame the wheel scrolls the page around it.
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

/** Radius in pixels of the brush on a surface that faces the camera. */
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

/** Picture of the mean of one model for its card; null until the viewer is loaded. */
export function cardPicture(side: Side, size: number): HTMLCanvasElement | null {
  const mean = geometry.peek()[side];
  const made = viewer.value;
  if (!mean || !made || mean.dimension !== dimension.peek()) return null;
  const content = cardContent(mean, side, scene.peek());
  if (!content) return null;
  const one: Scene = {
    ...scene.peek(),
    compared: null,
    shapes: {},
    mode: "mean",
    geometry: { a: mean, b: null },
  };
  return made.capture(Math.min(devicePixelRatio, 2), {
    width: size,
    height: size,
    layout: new Map([[content.region, { x: 0, y: 0, width: size, height: size }]]),
    panes: [content],
    frame: sceneFrame(one),
    camera: HOME,
    range: null,
  });
}
