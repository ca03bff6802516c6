/** Updates the viewer of the explorer when the explored shape, the camera or the colours change. */
import { batch, computed, effect, signal } from "@preact/signals";
import type { Region } from "../../../worker/protocol";
import { createViewer, layoutOf, scene } from "../../stage/stage-controller";
import { answer, basis, dragTool, explorer, grab, lockedHeat, settle } from "../../state/exploring";
import { otherSide } from "../../state/regions";
import { camera, embedded, vertex } from "../../state/state";
import { sceneFrame } from "../../viewer/contents";
import { listen } from "../../viewer/gestures";
import type { Frame, Hit, PaneContent, Viewer } from "../../viewer/viewer";
import { moveVertex, positionOf, takeVertex } from "./asking";
import {
  type ExploreScene,
  exploreContents,
  heatEnd,
  missedBy,
  movedFrom,
  panesOf,
} from "./contents";
import { stopPlaying } from "./playing";

/** The vertex under the pointer and its position on the canvas. */
export const exploreHover = signal<(Hit & { x: number; y: number; value: number | null }) | null>(
  null,
);

/** Position of the chosen vertex on the canvas, in each pane. */
export const vertexPositions = signal<{ region: Region; x: number; y: number }[]>([]);
/** The vertex that is dragged. */
const dragged = signal<number | null>(null);

const looks = computed(() => {
  const { magnify, style, layout, heat, morph } = explorer.value;
  return JSON.stringify([magnify, style, layout, heat, morph]);
});

const exploreScene = computed<ExploreScene | null>(() => {
  const found = answer.value;
  const from = basis.value;
  looks.value;
  if (!found || from?.axes.space !== found.space) return null;
  return {
    scene: scene.value,
    // Sliders are ahead of the answers; settings of the drawing apply at once.
    state: explorer.peek(),
    space: found.space,
    angles: found.kind === "angles",
    explored: found.explored,
    partner: found.partner,
    mean: from.mean,
  };
});

const contents = computed(() =>
  exploreScene.value === null ? [] : exploreContents(exploreScene.value),
);

/** Upper end of the colours if it is not locked. */
export const ownHeat = computed(() => {
  const found = answer.value;
  return found?.explored.nearest ? heatEnd(missedBy(found.space, found.explored.nearest)) : null;
});

export const heatRange = computed<[number, number] | null>(() => {
  looks.value;
  const end = lockedHeat.value ?? ownHeat.value;
  return explorer.peek().heat && end !== null ? [0, end] : null;
});

/** Factor by which the frame is larger than the means, for shapes three standard deviations away. */
const MARGIN = 1.14;

const frame = computed<Frame>(() => {
  const found = sceneFrame({ ...scene.value, mode: "mean" });
  return {
    ...found,
    halfWidth: MARGIN * found.halfWidth,
    halfHeight: MARGIN * found.halfHeight,
  };
});

/** Draws on a canvas with its panes; returns a function that ends it. */
export function takeExploreCanvas(
  canvas: HTMLCanvasElement,
  panes: Map<Region, HTMLElement>,
  flat: boolean,
): () => void {
  const stops: (() => void)[] = [];
  let gone = false;
  void createViewer(canvas, flat).then((made) => {
    if (gone) return made.dispose();
    stops.push(
      effect(drawing(made, flat)),
      effect(() => made.setCamera(camera.value)),
    );
    const laid = signal(0);
    const lay = () => {
      made.setLayout(...layoutOf(canvas, panes));
      laid.value += 1;
    };
    const observer = new ResizeObserver(lay);
    observer.observe(canvas);
    for (const pane of panes.values()) observer.observe(pane);
    stops.push(
      effect(() => {
        looks.value;
        requestAnimationFrame(lay);
      }),
      () => observer.disconnect(),
      effect(() => {
        laid.value;
        camera.value;
        const [shown, chosen] = [contents.value, dragged.value ?? vertex.value];
        // After the viewer has all panes.
        requestAnimationFrame(() => {
          vertexPositions.value = gone ? [] : positionsIn(made, shown, chosen);
        });
      }),
      listen(canvas, gestures(canvas, panes, made)),
      () => made.dispose(),
    );
  });
  return () => {
    gone = true;
    for (const stop of stops) stop();
    exploreHover.value = null;
    vertexPositions.value = [];
  };
}

/** Moves shapes whose points changed; draws everything else again. */
function drawing(made: Viewer, flat: boolean): () => void {
  let former: PaneContent[] = [];
  let lastFrame: Frame | null = null;
  return () => {
    const found = exploreScene.value;
    const dimension = found?.scene.geometry.a?.dimension ?? found?.scene.geometry.b?.dimension;
    if (!found || (dimension === 2) !== flat) return;
    const next = contents.value;
    made.setColors(heatRange.value);
    const moved = lastFrame === frame.value ? movedFrom(former, next) : null;
    if (moved) made.morph(moved);
    else made.setMesh(next, frame.value);
    former = next;
    lastFrame = frame.value;
  };
}

function positionsIn(made: Viewer, shown: PaneContent[], chosen: number | null) {
  if (chosen === null) return [];
  const seen = new Set<Region>();
  return shown.flatMap(({ region, moves, shapes: [shape] }) => {
    const point = moves && shape && !seen.has(region) ? positionOf(shape, chosen) : null;
    const position = point && made.positionOf(region, point);
    if (!position) return [];
    seen.add(region);
    return [{ region, ...position }];
  });
}

function gestures(canvas: HTMLCanvasElement, panes: Map<Region, HTMLElement>, made: Viewer) {
  const wide = matchMedia("(min-width: 1100px)");
  /** Offset from the pointer to the drawn vertex when the drag began. */
  let away = { x: 0, y: 0 };
  return {
    paints: (at?: { x: number; y: number }) => {
      if (!dragTool.peek() || !at) return false;
      const hit = made.pick(at.x, at.y);
      if (!hit || hit.region !== explorer.peek().space) return false;
      const held = takeVertex(hit.vertex);
      const drawn = held && made.positionOf(hit.region, asDrawn(held.vertex, held.to));
      if (!drawn) return false;
      away = { x: drawn.x - at.x, y: drawn.y - at.y };
      dragged.value = hit.vertex;
      return true;
    },
    beginStroke: stopPlaying,
    endStroke: () => {
      // One step of undo: the vertex and its new position.
      batch(() => {
        vertex.value = dragged.value;
        dragged.value = null;
        settle();
      });
    },
    dropStroke: () => {
      const held = grab.peek();
      if (held) moveVertex(held.from);
      dragged.value = null;
    },
    paint: (x: number, y: number) => {
      const held = grab.peek();
      if (!held) return;
      const through = asDrawn(held.vertex, held.to);
      const position = made.pointAt(held.space, through, x + away.x, y + away.y);
      if (position) moveVertex(asMeant(held.vertex, position));
    },
    camera: () => camera.peek(),
    setCamera: (next: typeof camera.value) => {
      camera.value = next;
    },
    flat: () => scene.peek().geometry.a?.dimension === 2,
    ownsWheel: () => !embedded.peek() && wide.matches,
    pixelsPerRadius: () => {
      const [shown] = panesOf(explorer.peek());
      return Math.max(40, ((shown && panes.get(shown)?.clientHeight) ?? 200) / 2.2);
    },
    hover: (x: number, y: number) => {
      const hit = made.pick(x, y);
      exploreHover.value = hit && { ...hit, x, y, value: missedAt(hit) };
      const takes = dragTool.peek() && hit?.region === explorer.peek().space;
      canvas.style.cursor = takes ? "move" : "";
    },
    leave: () => {
      exploreHover.value = null;
    },
    tap: () => {},
  };
}

/** Position at which a vertex is drawn: its deviation from the mean is magnified. */
function asDrawn(vertex: number, point: readonly number[]): number[] {
  const { magnify } = explorer.peek();
  return point.map((value, axis) => {
    const middle = meanAt(vertex, axis, point.length);
    return middle + magnify * (value - middle);
  });
}

function asMeant(vertex: number, drawn: readonly number[]): number[] {
  const { magnify } = explorer.peek();
  return drawn.map((value, axis) => {
    const middle = meanAt(vertex, axis, drawn.length);
    return middle + (value - middle) / magnify;
  });
}

function meanAt(vertex: number, axis: number, dimension: number): number {
  return basis.peek()?.mean[vertex * dimension + axis] ?? 0;
}

/** Residual of a vertex in the pane that shows it. */
function missedAt(hit: Hit): number | null {
  const found = answer.peek();
  const nearest = found?.explored.nearest;
  if (!found || !nearest) return null;
  if (found.space === "intersection") {
    const side = hit.region === "b" ? "b" : "a";
    return hit.region === "intersection" ? null : (nearest[side].residuals[hit.vertex] ?? null);
  }
  return nearest[otherSide(found.space)].residuals[hit.vertex] ?? null;
}
