import { resample } from "../comparison";
import { VIEW_MODES, type ViewMode } from "../link";
import { savePicture } from "../picture";
import { camera, lockedRange, outOfDate, region, view } from "../state";
import { HOME } from "../viewer/camera";
import { range } from "../viewer/stage-controller";
import { DownloadIcon } from "./icons";

const LABELS: Record<ViewMode, string> = {
  mean: "Mean",
  samples: "Samples",
  sd: "Standard deviation",
};

export function Toolbar() {
  return (
    <div class="toolbar">
      <fieldset class="segments">
        <legend class="unseen">What is drawn</legend>
        {VIEW_MODES.map((mode) => (
          <label key={mode} data-on={view.value === mode}>
            <input
              type="radio"
              name="view"
              value={mode}
              checked={view.value === mode}
              onChange={() => {
                view.value = mode;
              }}
            />
            {LABELS[mode]}
          </label>
        ))}
      </fieldset>
      {view.value === "samples" && (
        <button type="button" class="quiet" onClick={resample}>
          Resample
        </button>
      )}
      {view.value === "sd" && (
        <label class="check">
          <input
            type="checkbox"
            checked={lockedRange.value !== null}
            onChange={(event) => {
              lockedRange.value = event.currentTarget.checked ? range.value : null;
            }}
          />
          Lock scale
        </label>
      )}
      <span class="grow">{outOfDate.value && <span class="stale-chip">Out of date</span>}</span>
      {region.value !== null && (
        <button
          type="button"
          class="quiet"
          onClick={() => {
            region.value = null;
          }}
        >
          All five
        </button>
      )}
      <button
        type="button"
        class="quiet"
        onClick={() => {
          camera.value = HOME;
        }}
      >
        Reset view
      </button>
      <button type="button" class="quiet" onClick={() => void savePicture()}>
        <DownloadIcon />
        <span>PNG</span>
      </button>
    </div>
  );
}
