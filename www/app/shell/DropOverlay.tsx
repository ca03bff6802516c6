import { dropSide } from "./drop";

/** Two halves while files are dragged over the window. */
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
        Two models at once fill both, more make a table; a folder of meshes makes one. Your files
        stay on this computer.
      </p>
    </div>
  );
}
