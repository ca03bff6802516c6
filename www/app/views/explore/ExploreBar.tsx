/** How the explored shapes are drawn. */
import {
  type ExploreLayout,
  LAYOUTS,
  MOST_MAGNIFY,
  STYLES,
  type SurfaceStyle,
} from "../../explore/codec";
import { ownHeat } from "../../explore/controller";
import { choose, dragTool, explore, explorer, lockedHeat, settle } from "../../explore/state";
import { camera } from "../../state";
import { HOME } from "../../viewer/camera";

const LAYOUT_NAMES: Record<ExploreLayout, string> = {
  side: "Side by side",
  overlaid: "Overlaid",
  a: "A alone",
  b: "B alone",
};
const STYLE_NAMES: Record<SurfaceStyle, string> = {
  smooth: "Smooth",
  flat: "Flat",
  wireframe: "Wireframe",
};

export function ExploreBar() {
  const { layout, style, heat, magnify } = explorer.value;
  return (
    <div class="toolbar">
      <select
        aria-label="Layout"
        value={layout}
        onChange={(event) => choose({ layout: event.currentTarget.value as ExploreLayout })}
      >
        {LAYOUTS.map((name) => (
          <option key={name} value={name}>
            {LAYOUT_NAMES[name]}
          </option>
        ))}
      </select>
      <select
        aria-label="Surface"
        value={style}
        onChange={(event) => choose({ style: event.currentTarget.value as SurfaceStyle })}
      >
        {STYLES.map((name) => (
          <option key={name} value={name}>
            {STYLE_NAMES[name]}
          </option>
        ))}
      </select>
      <label class="slider magnify">
        <span>Magnify</span>
        <input
          type="range"
          min={1}
          max={MOST_MAGNIFY}
          step={0.5}
          value={magnify}
          aria-valuetext={`deviations from the mean ${magnify} times as large`}
          onInput={(event) => explore({ magnify: Number(event.currentTarget.value) })}
          onChange={settle}
        />
        <span class="num">{magnify}×</span>
      </label>
      <label class="check">
        <input
          type="checkbox"
          checked={heat}
          onChange={(event) => choose({ heat: event.currentTarget.checked })}
        />
        Colour misses
      </label>
      {heat && (
        <label class="check">
          <input
            type="checkbox"
            checked={lockedHeat.value !== null}
            onChange={(event) => {
              lockedHeat.value = event.currentTarget.checked ? ownHeat.value : null;
            }}
          />
          Lock scale
        </label>
      )}
      <button
        type="button"
        class="quiet"
        aria-pressed={dragTool.value}
        title="Drag a vertex of the driven shape; the rest follows"
        onClick={() => {
          dragTool.value = !dragTool.value;
        }}
      >
        Drag vertices
      </button>
      <span class="grow" />
      <button
        type="button"
        class="quiet"
        onClick={() => {
          camera.value = HOME;
        }}
      >
        Reset view
      </button>
    </div>
  );
}
