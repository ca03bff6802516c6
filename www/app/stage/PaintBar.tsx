import { useLayoutEffect, useRef } from "preact/hooks";
import {
  BRUSHES,
  beginStroke,
  cancelPainting,
  chooseBrush,
  choosePaintTool,
  clearPainting,
  finishPainting,
  invertPainting,
  paintedCount,
  undoStroke,
} from "../models/painting";
import { type PaintTool, painting } from "../state/state";
import { count } from "../text/format";
import { maskOf, parseRanges, rangesOf } from "../text/ranges";
import { Segments } from "../ui/Segments";
import { Slider } from "../ui/Slider";

const TOOLS: Record<PaintTool, { label: string; key: string }> = {
  add: { label: "Add", key: "a" },
  erase: { label: "Erase", key: "e" },
  turn: { label: "Turn", key: "t" },
};

/** Toolbar for painting the compared points on A: tools, brush size, typed vertices. */
export function PaintBar() {
  const found = painting.value;
  const bar = useRef<HTMLElement>(null);
  // Before the page is painted: a key may follow the click at once.
  useLayoutEffect(() => {
    // On a small screen the shape may be out of view.
    bar.current?.scrollIntoView({ block: "nearest" });
    addEventListener("keydown", onKey);
    return () => removeEventListener("keydown", onKey);
  }, []);
  if (!found) return null;
  return (
    <section ref={bar} class="paint-bar" aria-label="Painting a region of A">
      <div class="toolbar">
        <Segments
          legend="What dragging does"
          name="paint-tool"
          value={found.tool}
          options={(Object.keys(TOOLS) as PaintTool[]).map((tool) => [
            tool,
            TOOLS[tool].label,
            `Key ${TOOLS[tool].key}`,
          ])}
          onChoose={choosePaintTool}
        />
        <Slider
          label="Brush"
          value={found.size}
          least={BRUSHES.least}
          most={BRUSHES.most}
          step={0.01}
          words={`${Math.round(100 * found.size)} per cent of the size of A`}
          onMove={chooseBrush}
        />
        <span class="grow" />
        <button type="button" class="quiet" onClick={cancelPainting}>
          Cancel
        </button>
        <button type="button" class="primary" onClick={finishPainting}>
          Done
        </button>
      </div>
      <div class="toolbar">
        <output class="painted">
          <strong class="num">{count(paintedCount.value)}</strong> of {count(found.mask.length)}{" "}
          points
        </output>
        <button type="button" class="quiet" onClick={invertPainting}>
          Invert
        </button>
        <button type="button" class="quiet" onClick={clearPainting}>
          Clear
        </button>
        <input
          type="text"
          class="ranges"
          aria-label="Vertices of the region"
          placeholder="or type vertices: 0-99, 120"
          value={rangesOf(found.mask)}
          onChange={(event) => take(event.currentTarget)}
          autocomplete="off"
          spellcheck={false}
        />
      </div>
    </section>
  );
}

function take(input: HTMLInputElement): void {
  const found = painting.value;
  const ranges = input.value.trim() === "" ? "" : parseRanges(input.value);
  input.setAttribute("aria-invalid", String(ranges === "invalid"));
  if (!found || ranges === "invalid") return;
  beginStroke();
  painting.value = { ...found, mask: maskOf(ranges, found.mask.length) };
}

function onKey(event: KeyboardEvent): void {
  const typing = event.target instanceof HTMLInputElement && event.target.type === "text";
  if (event.key === "Escape") cancelPainting();
  if (typing || event.altKey) return;
  if (event.ctrlKey || event.metaKey) {
    if (event.key.toLowerCase() !== "z" || event.shiftKey) return;
    event.preventDefault();
    undoStroke();
    return;
  }
  const tool = (Object.keys(TOOLS) as PaintTool[]).find((name) => TOOLS[name].key === event.key);
  if (tool) choosePaintTool(tool);
}
