/** Canvas of the explorer with three panes under one camera: A, both models overlaid, and B. */
import { useEffect, useRef } from "preact/hooks";
import type { Region } from "../../../worker/protocol";
import { PaneView, ShapesCanvas } from "../../stage/ShapesCanvas";
import { dimension } from "../../stage/stage-controller";
import { answer, dragTool, explorer, trouble } from "../../state/exploring";
import { run, unit } from "../../state/state";
import { length } from "../../text/format";
import { EXPLORE_PANES, type ExplorePane, panesOf } from "./contents";
import { exploreHover, takeExploreCanvas, vertexPositions } from "./controller";
import { ExploreBar } from "./ExploreBar";
import { Follow } from "./Follow";
import { HeatBar } from "./HeatBar";
import { otherOf, SIGNS } from "./words";

export function ExploreStage() {
  const kind = dimension.value;
  return (
    <section class="stage explore-stage" aria-label="Explored shapes" data-region="all">
      <ExploreBar />
      <div class="field-of-view" data-drag={dragTool.value}>
        {kind !== null && <Panes key={kind} flat={kind === 2} />}
        <Tooltip />
        {vertexPositions.value.map(({ region, x, y }) => (
          <span
            key={region}
            class="vertex-place"
            aria-hidden="true"
            style={{ left: `${x}px`, top: `${y}px` }}
          />
        ))}
      </div>
      <HeatBar />
      <Follow />
    </section>
  );
}

function Panes({ flat }: { flat: boolean }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const panes = useRef(new Map<Region, HTMLElement>());
  useEffect(
    () => (canvas.current ? takeExploreCanvas(canvas.current, panes.current, flat) : undefined),
    [flat],
  );
  const shown = panesOf(explorer.value);
  return (
    <>
      <ShapesCanvas canvas={canvas} label={canvasLabel()} help="explore-help">
        Drag or use the arrow keys to {flat ? "shift" : "turn"} all shapes at once
      </ShapesCanvas>
      <div class="panes" data-shown={shown.length}>
        {EXPLORE_PANES.map((name) => (
          <div
            key={name}
            class="pane"
            data-pane={name}
            data-driven={explorer.value.space === name}
            data-away={!shown.includes(name)}
          >
            <PaneView name={name} panes={panes.current} />
            <p class="pane-label">
              <strong>{sign(name)}</strong> <span class="pane-meaning">{meaning(name)}</span>
            </p>
          </div>
        ))}
        {answer.value === null && (
          <p class="explore-note">
            {trouble.value ??
              (run.value ? "shown once the comparison is prepared" : "waiting for the engine")}
          </p>
        )}
      </div>
    </>
  );
}

function canvasLabel(): string {
  const { space } = explorer.value;
  return space === "intersection"
    ? "A shape of A∩B, and the nearest of A and of B"
    : `A shape of ${SIGNS[space]}, and the nearest of ${SIGNS[otherOf(space)]}`;
}

/** Label of a pane; the middle one is A∩B only while a shape of A∩B is set. */
function sign(pane: ExplorePane): string {
  const { space, kind } = explorer.value;
  if (pane !== "intersection" || space === "intersection") return SIGNS[pane];
  return kind === "angles" ? "A–B" : "A, B";
}

/** What a pane shows: the shape that is set, the nearest shape of the other model, or both. */
function meaning(pane: ExplorePane): string {
  const { space, kind } = explorer.value;
  if (pane === space) return kind === "angles" ? "the direction" : "the shape";
  if (kind === "angles" && space !== "intersection") {
    return pane === "intersection" ? "between the two" : "its partner direction";
  }
  if (pane !== "intersection") return "its nearest shape";
  return space === "intersection" ? "" : "overlaid";
}

function Tooltip() {
  const hit = exploreHover.value;
  if (!hit) return null;
  return (
    <output class="tip" style={{ left: `${hit.x}px`, top: `${hit.y}px` }} aria-hidden="true">
      {hit.region === "intersection" ? "" : `${SIGNS[hit.region as "a" | "b"]} · `}vertex{" "}
      {hit.vertex}
      {hit.value !== null && <strong> {length(hit.value, unit.value)} missed</strong>}
    </output>
  );
}
