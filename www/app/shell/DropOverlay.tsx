import { dropSide } from "./drop";

/** Overlay while files are dragged over the window: one half for A, one for B. */
export function DropOverlay() {
  const side = dropSide.value;
  if (side === null) return null;
  return (
    <div class="drop" aria-hidden="true">
      {(["a", "b"] as const).map((half) => (
        <div key={half} class="drop-half" data-side={half} data-on={side === half}>
          <span class="drop-letter">{half.toUpperCase()}</span>
          <span>Drop here to open as model {half.toUpperCase()}</span>
        </div>
      ))}
      <p class="drop-note">
        Two models are opened as A and B, more as a table of pairs; a folder of meshes is one model.
        Your files stay on this computer.
      </p>
    </div>
  );
}
