import { useEffect, useRef } from "preact/hooks";
import type { Region } from "../../../worker/protocol";
import { ColorBar } from "../../stage/ColorBar";
import { MAP_WORDS, mapUnit } from "../../stage/map-words";
import { shownMap } from "../../stage/maps";
import { REGION_NAMES, regionLabel, shownIn } from "../../stage/names";
import { PaintBar } from "../../stage/PaintBar";
import { PaneView, ShapesCanvas } from "../../stage/ShapesCanvas";
import { brush, dimension, hover, scene, takeCanvas } from "../../stage/stage-controller";
import { VennMap } from "../../stage/VennMap";
import { VertexBar } from "../../stage/VertexBar";
import { isDifference } from "../../state/regions";
import {
  alone,
  compared,
  emptyRegions,
  opening,
  outOfDate,
  painting,
  region,
  result,
  run,
  SIDES,
  shapes,
  slots,
  tab,
  unit,
  vertexMap,
  view,
} from "../../state/state";
import { isColoured } from "../../state/view";
import { number, signed, withoutRoundingError } from "../../text/format";
import { BackIcon, ExpandIcon } from "../../ui/icons";
import { contentOf, ownGeometry } from "../../viewer/contents";
import { ContrastCaption } from "./ContrastCaption";
import { DifferenceBar } from "./DifferenceBar";
import { PairsBar } from "./PairsBar";
import { Toolbar } from "./Toolbar";

/** The five regions side by side: A at the left, B at the right, A∩B between them above the Venn diagram. */
const ORDER: (Region | "map")[] = ["a", "intersection", "b", "aWithoutB", "map", "bWithoutA"];

export function Stage() {
  // A canvas cannot change from a 2-D to a WebGL context: flat and spatial models get different ones.
  const kind = dimension.value;
  const paints = painting.value !== null;
  return (
    <section
      class="stage"
      aria-label="Shapes"
      hidden={tab.value !== "regions"}
      data-region={alone.value ?? "all"}
      data-view={view.value}
      data-paint={painting.value?.tool}
      data-stale={outOfDate.value && !paints && !run.value?.progress?.hasIntersection}
    >
      {paints ? <PaintBar /> : <Toolbar />}
      <div class="field-of-view">
        <Panes key={kind === 2 ? "flat" : "space"} live={kind !== null} />
        <Tooltip />
        <Brush />
      </div>
      {!paints && (
        <>
          <DifferenceBar />
          {view.value === "contrast" && <ContrastCaption />}
          {view.value === "pairs" && <PairsBar />}
          {isColoured(view.value) && <ColorBar />}
          <VertexBar />
        </>
      )}
    </section>
  );
}

function Panes({ live }: { live: boolean }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const panes = useRef(new Map<Region, HTMLElement>());
  useEffect(() => {
    if (!live || !canvas.current) return;
    return takeCanvas(canvas.current, panes.current);
  }, [live]);
  const flat = dimension.value === 2;
  return (
    <>
      <ShapesCanvas canvas={canvas} label={canvasLabel()} help="canvas-help">
        {painting.value && "Space paints in the middle. "}
        Drag or use the arrow keys to {flat ? "shift" : "turn all shapes at once"}
      </ShapesCanvas>
      <div class="panes">
        {ORDER.map((name) =>
          name === "map" ? (
            <VennMap key={name} />
          ) : (
            <Pane key={name} name={name} panes={panes.current} />
          ),
        )}
      </div>
    </>
  );
}

function canvasLabel(): string {
  if (painting.value) return "Mean shape of A, to paint on";
  const map = vertexMap.value === "sd" ? "Standard deviations" : MAP_WORDS[vertexMap.value].label;
  const what = {
    contrast: "What each model misses of the other",
    pairs: "Shapes beside the nearest of the other model",
    mean: "Mean shapes",
    samples: "Random shapes",
    sd: map,
  }[view.value];
  if (view.value === "contrast" || view.value === "pairs") {
    return alone.value === null ? what : `${what}, ${REGION_NAMES[alone.value].sign}`;
  }
  return alone.value === null
    ? `${what} of the five regions`
    : `${what} of ${regionLabel(alone.value)}`;
}

function Pane({ name, panes }: { name: Region; panes: Map<Region, HTMLElement> }) {
  const shown = alone.value === name;
  const away = alone.value !== null && !shown;
  const { sign } = REGION_NAMES[name];
  const paints = painting.value !== null;
  return (
    <div class="pane" data-pane={name} data-away={away}>
      <PaneView name={name} panes={panes} />
      <p class="pane-label">
        <strong>{sign}</strong>{" "}
        <span class="pane-meaning">
          {paints ? "which of its points are compared" : shownIn(name)}
        </span>
      </p>
      {!paints && (
        <button
          type="button"
          class="quiet icon-only pane-zoom"
          onClick={() => {
            region.value = shown ? null : name;
          }}
          aria-label={shown ? "Show all five regions" : `Show ${sign} alone`}
          title={shown ? "Show all five regions" : `Show ${sign} alone`}
        >
          {shown ? <BackIcon /> : <ExpandIcon />}
        </button>
      )}
      {!paints && <PaneNote name={name} />}
    </div>
  );
}

function PaneNote({ name }: { name: Region }) {
  const empty = emptyRegions.value[name];
  const drawn = contentOf(scene.value, name) !== null;
  if (empty && !drawn)
    return <p class="pane-note">{isEmpty(name) ? "Empty: there is no such shape." : empty}</p>;
  if (drawn) {
    const guess = shapes.value[name]?.source === "fit" && run.value;
    return guess ? <p class="pane-note">Gaussian fit</p> : null;
  }
  const loads = !slots.a.value && SIDES.some((side) => opening[side].value);
  return <p class="pane-note">{run.value ? "waiting for draws" : loads ? "loading" : ""}</p>;
}

/** Whether a finished difference has no shapes. */
function isEmpty(name: Region): boolean {
  return isDifference(name) && result.value?.report.differences[name].diagnostics.draws === 0;
}

function Tooltip() {
  const hit = hover.value;
  if (!hit || painting.value?.tool === "add" || painting.value?.tool === "erase") return null;
  const value = valueAt(hit.region, hit.vertex);
  return (
    <output class="tip" style={{ left: `${hit.x}px`, top: `${hit.y}px` }} aria-hidden="true">
      {REGION_NAMES[hit.region].sign} · {compared.value ? "compared point" : "vertex"} {hit.vertex}
      {view.value === "samples" && hit.shape >= 0 && !dimensionIsFlat()
        ? ` · shape ${hit.shape + 1}`
        : ""}
      {value !== null && <strong> {value}</strong>}
    </output>
  );
}

/** Value of the map at a vertex, with its unit; for mean shapes its standard deviation. */
function valueAt(name: Region, vertex: number): string | null {
  if (view.value === "samples") return null;
  if (isColoured(view.value)) {
    const map = shownMap.value;
    const value = map.values[name]?.[vertex];
    if (value === undefined) return null;
    const size = map.name === "ratio" ? 0 : (slots.a.value?.report.size ?? 0);
    const text = (map.signed ? signed : number)(withoutRoundingError(value, size));
    return `${map.name === "sd" ? "SD " : ""}${text} ${mapUnit(map.name, unit.value)}`;
  }
  const own = ownGeometry(scene.value, name);
  const deviation = shapes.value[name]?.vertexSd[vertex] ?? own?.vertexSd[vertex];
  return deviation === undefined ? null : `SD ${number(deviation)} ${unit.value}`;
}

/** Circle that shows the radius of the brush. */
function Brush() {
  const found = brush.value;
  if (!found || !painting.value) return null;
  const { x, y, radius } = found;
  const [left, top, width] = [`${x - radius}px`, `${y - radius}px`, `${2 * radius}px`];
  return <div class="brush" aria-hidden="true" style={{ left, top, width, height: width }} />;
}

function dimensionIsFlat(): boolean {
  return dimension.value === 2;
}
