/** Toolbar of the explorer: layout of the panes, surface style, dragging of vertices, view. */

import { ResetView } from "../../stage/ShapesCanvas";
import { type ExploreLayout, LAYOUTS, STYLES, type SurfaceStyle } from "../../state/explorer";
import { choose, dragTool, explorer } from "../../state/exploring";
import { SIDES, slots } from "../../state/state";
import { Select } from "../../ui/Select";

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
  const { layout, style } = explorer.value;
  const surfaces = SIDES.some((side) => slots[side].value?.geometry?.triangles);
  return (
    <div class="toolbar">
      <Select
        label="Layout"
        value={layout}
        options={LAYOUTS.map((name) => [name, LAYOUT_NAMES[name]])}
        onChoose={(name) => choose({ layout: name })}
      />
      {surfaces && (
        <Select
          label="Surface"
          value={style}
          options={STYLES.map((name) => [name, STYLE_NAMES[name]])}
          onChoose={(name) => choose({ style: name })}
        />
      )}
      <button
        type="button"
        class="toggle"
        aria-pressed={dragTool.value}
        title="Drag a vertex of the shape; the model completes the rest with the smallest change in standard deviations"
        onClick={() => {
          dragTool.value = !dragTool.value;
        }}
      >
        Drag vertices
      </button>
      <span class="grow" />
      <ResetView />
    </div>
  );
}
