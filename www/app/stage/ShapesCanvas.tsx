/** The canvas on which shapes are drawn, and the places of the panes on it. */
import type { ComponentChildren, RefObject } from "preact";
import type { Region } from "../../worker/protocol";
import { HOME } from "../state/camera";
import { camera } from "../state/state";

interface Props {
  canvas: RefObject<HTMLCanvasElement | null>;
  label: string;
  /** Id of the help. */
  help: string;
  /** What dragging and the arrow keys do, for screen readers. */
  children: ComponentChildren;
}

export function ShapesCanvas({ canvas, label, help, children }: Props) {
  return (
    <>
      {/* biome-ignore lint/a11y/noInteractiveElementToNoninteractiveRole: arrow keys are ours here, and role="img" would take them away in screen readers */}
      <canvas
        ref={canvas}
        class="shapes"
        tabIndex={0}
        role="application"
        aria-label={label}
        aria-describedby={help}
      />
      <p id={help} class="unseen">
        {children}, plus and minus to zoom, 0 to go back to the first view.
      </p>
    </>
  );
}

/** Place of a pane on the canvas, which is kept in `panes` while it is on the page. */
export function PaneView({ name, panes }: { name: Region; panes: Map<Region, HTMLElement> }) {
  return (
    <div
      class="pane-view"
      ref={(element) => {
        if (element) panes.set(name, element);
        else panes.delete(name);
      }}
    />
  );
}

export function ResetView() {
  return (
    <button
      type="button"
      class="quiet"
      onClick={() => {
        camera.value = HOME;
      }}
    >
      Reset view
    </button>
  );
}
