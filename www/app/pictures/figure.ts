/** Draws figures of five blocks: random shapes and variances as in the paper, maps, means, the contrast. */
import { signal } from "@preact/signals";
import type { Region, RegionShapes } from "../../worker/protocol";
import { shapeCount } from "../comparison/run";
import { contrastSentence } from "../stage/contrast";
import { mapCaption, scaleEnds } from "../stage/map-words";
import {
  chosenMap,
  contrastMap,
  deviationMap,
  ellipsoids,
  mapRange,
  pairsMap,
  rangeOf,
  type ShownMap,
  shownMap,
} from "../stage/maps";
import { differencePicture, REGION_NAMES } from "../stage/names";
import { pairsSentence } from "../stage/pairs";
import { mapOf, scene } from "../stage/stage-controller";
import { engineClient, report as reportError } from "../state/engine";
import { REGIONS } from "../state/regions";
import {
  camera,
  exaggeration,
  held,
  picture,
  result,
  shapes,
  shapesSeed,
  unit,
  vertex,
} from "../state/state";
import { isColoured, type ViewMode } from "../state/view";
import { saveBlob } from "../ui/download";
import { contentsOf, ELLIPSOID_SD, type Scene, sceneFrame } from "../viewer/contents";
import type { Frame, PaneContent } from "../viewer/viewer";
import { captionOf, type FigureKind } from "./caption";
import {
  captionLine,
  type FigureLayout,
  type FigureSize,
  LARGEST_PX,
  layoutFigure,
  UNITS_PER_INCH,
  widthInPixels,
  wrapped,
} from "./layout";
import { type Bar, drawBar, FONT, INK } from "./lettering";
import { offscreenViewer } from "./offscreen";
import { withResolution } from "./png";

export type Background = "white" | "transparent" | "dark";

export interface FigureOptions extends FigureSize {
  shows: FigureKind;
  background: Background;
  labels: boolean;
  bar: boolean;
  caption: boolean;
  /** Shapes in a block, if they are side by side. */
  shapes: number;
  /** Size of the lettering, in points. */
  points: number;
}

/** Default options: the width of a page of the paper. */
export const FIRST_OPTIONS: FigureOptions = {
  shows: "shapes",
  width: 174,
  unit: "mm",
  dpi: 300,
  background: "white",
  labels: true,
  bar: true,
  caption: true,
  shapes: 9,
  points: 8,
};

/** The chosen options, kept while the page is open. */
export const figureOptions = signal<FigureOptions>(FIRST_OPTIONS);

/** Contents of a figure without its size in pixels. */
interface Figure {
  layout: FigureLayout;
  contents: PaneContent[];
  frame: Frame;
  range: Bar["range"] | null;
  bar: Bar | null;
  lines: string[];
  em: number;
  options: FigureOptions;
}

const MODES: Record<FigureKind, ViewMode> = {
  shapes: "samples",
  variance: "sd",
  map: "sd",
  means: "mean",
  contrast: "contrast",
  pairs: "pairs",
};

/** Figures of other shapes than means, to which the ellipsoids do not belong. */
const WITHOUT_ELLIPSOIDS: FigureKind[] = ["shapes", "contrast", "pairs"];

type Shapes = Partial<Record<Region, RegionShapes>>;

let kept: { key: string; shapes: Shapes } | null = null;

/** The shapes of a figure: those of the page, or requested ones of the same seed if more are wanted. */
async function shapesFor({ shows, shapes: count }: FigureOptions): Promise<Shapes> {
  const shown = shapes.peek();
  if (shows !== "shapes" || isOverlaid() || count === shapeCount()) return shown;
  const [seed, pushed, of] = [shapesSeed.peek(), exaggeration.peek(), picture.peek()];
  const key = JSON.stringify([held.peek()?.key, result.peek()?.cancelled, count, seed, pushed, of]);
  if (kept?.key === key) return kept.shapes;
  const found: Shapes = {};
  const { signal: never } = new AbortController();
  await Promise.all(
    REGIONS.filter((name) => shown[name]).map(async (name) => {
      found[name] = await engineClient().region(never, name, count, seed, pushed, of);
    }),
  );
  kept = { key, shapes: found };
  return found;
}

/** Whether all shapes of a block are overlaid. */
function isOverlaid(): boolean {
  return contentsOf({ ...scene.peek(), mode: "samples" }, REGIONS).some((one) => one.overlaid);
}

export function captionFor(options: FigureOptions): string {
  const report = result.value?.report;
  if (!report) return "";
  const map = mapFor(options.shows);
  const number = vertex.value;
  const [ellipsoid] = Object.values(ellipsoids.value);
  const overlaid = isOverlaid();
  return captionOf(
    {
      shows: options.shows,
      map: mapCaption(map.name, map, unit.value),
      shapes: overlaid ? shapeCount() : options.shapes,
      overlaid,
      // What a contrast or a pair shows is not the draws, exaggerated or not.
      differences: differencePicture(MODES[options.shows]),
      contrast: (options.shows === "pairs" ? pairsSentence : contrastSentence).value,
      vertex:
        number !== null && ellipsoid
          ? { number, deviations: ELLIPSOID_SD, dimension: ellipsoid.centre.length === 2 ? 2 : 3 }
          : null,
    },
    report,
  );
}

async function compose(options: FigureOptions): Promise<Figure> {
  const { shows, background, dpi } = options;
  const found: Scene = {
    ...scene.peek(),
    mode: MODES[shows],
    dark: background === "dark",
    shapes: await shapesFor(options),
    map: mapOf(mapFor(shows)),
    ...(WITHOUT_ELLIPSOIDS.includes(shows) ? { ellipsoids: {} } : {}),
  };
  const scale = isColoured(MODES[shows]) ? barOf(mapFor(shows)) : null;
  const bar = options.bar ? scale : null;
  const frame = sceneFrame(found);
  const contents = contentsOf(found, REGIONS);
  const em = (options.points / 72) * UNITS_PER_INCH;
  const width = (widthInPixels(options) / dpi) * UNITS_PER_INCH;
  const lines = options.caption ? captionLines(captionFor(options), width, em) : [];
  const layout = layoutFigure(width, frame, {
    em,
    cells: Math.max(1, ...contents.map((one) => (one.overlaid ? 1 : one.shapes.length))),
    labels: options.labels,
    bar: bar !== null,
    captionLines: lines.length,
  });
  return { layout, contents, frame, range: scale?.range ?? null, bar, lines, em, options };
}

function captionLines(text: string, width: number, em: number): string[] {
  const pen = document.createElement("canvas").getContext("2d");
  if (!pen) return [];
  pen.font = `${em}px ${FONT}`;
  return wrapped(text, width - 2 * em, (part) => pen.measureText(part).width);
}

/** Draws a figure in one task at a width in pixels; null if there is nothing to draw. */
export async function drawFigure(
  options: FigureOptions,
  across: number,
): Promise<HTMLCanvasElement | null> {
  const figure = await compose(options);
  const { layout, contents } = figure;
  const scale = across / layout.width;
  if (contents.length === 0) return null;
  if (Math.max(layout.width, layout.height) * scale > LARGEST_PX + 1) {
    throw new Error(`That is more than ${LARGEST_PX} pixels high. Choose fewer pixels.`);
  }
  const viewer = await offscreenViewer();
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(layout.width * scale);
  canvas.height = Math.round(layout.height * scale);
  const pen = canvas.getContext("2d");
  if (!pen) return null;
  if (options.background === "white") {
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, canvas.width, canvas.height);
  }
  const shot = viewer.capture(scale, {
    width: layout.width,
    height: layout.height,
    layout: layout.blocks,
    panes: contents,
    frame: figure.frame,
    camera: camera.peek(),
    range: figure.range,
  });
  pen.drawImage(shot, 0, 0);
  pen.scale(scale, scale);
  letter(pen, figure);
  return canvas;
}

function letter(pen: CanvasRenderingContext2D, figure: Figure): void {
  const { layout, lines, em, options, contents, bar } = figure;
  pen.fillStyle = INK[options.background === "dark" ? "dark" : "light"];
  pen.font = `600 ${1.15 * em}px ${FONT}`;
  for (const { region } of options.labels ? contents : []) {
    pen.fillText(REGION_NAMES[region].sign, layout.blocks.get(region)?.x ?? 0, layout.labels);
  }
  const left = layout.blocks.get("a")?.x ?? 0;
  if (bar) drawBar(pen, bar, { left, top: layout.bar, width: layout.width - 2 * left, em });
  pen.font = `${em}px ${FONT}`;
  lines.forEach((line, i) => {
    pen.fillText(line, left, captionLine(layout, em, i));
  });
}

function mapFor(shows: FigureKind): ShownMap {
  if (shows === "contrast") return contrastMap.value;
  if (shows === "pairs") return pairsMap.value;
  return shows === "variance" ? deviationMap.value : chosenMap.value;
}

/** The colour range of a map in a figure; locked if that of the page is. */
export function barOf(map: ShownMap): Bar | null {
  const range = map === shownMap.peek() ? mapRange.peek() : rangeOf(map);
  return (
    range && {
      range,
      palette: map.palette,
      caption: mapCaption(map.name, map, unit.peek()),
      ends: scaleEnds(map.name, map.signed),
    }
  );
}

/** Draws a figure at its size and saves it. */
export async function saveFigure(options: FigureOptions): Promise<void> {
  try {
    const canvas = await drawFigure(options, widthInPixels(options));
    if (!canvas) throw new Error("There are no shapes to draw yet.");
    const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve));
    if (!blob) throw new Error("This browser cannot make a picture of that size.");
    const png = withResolution(new Uint8Array(await blob.arrayBuffer()), options.dpi);
    saveBlob(`shapevenn-figure-${options.shows}.png`, new Blob([png], { type: "image/png" }));
  } catch (thrown) {
    reportError("page", thrown);
  }
}
