import { resample } from "../../comparison/run";
import { pictureDialog } from "../../pictures/PictureDialogs";
import { savePicture } from "../../pictures/picture";
import { MapChooser } from "../../stage/MapChooser";
import { chooseView } from "../../stage/maps";
import { ResetView } from "../../stage/ShapesCanvas";
import { outOfDate, region, view } from "../../state/state";
import { VIEW_MODES, type ViewMode } from "../../state/view";
import { DownloadIcon } from "../../ui/icons";
import { Segments } from "../../ui/Segments";

const LABELS: Record<ViewMode, string> = {
  contrast: "Contrast",
  pairs: "Pairs",
  mean: "Mean",
  samples: "Samples",
  sd: "Map",
};

export function Toolbar() {
  return (
    <div class="toolbar">
      <Segments
        legend="What is drawn"
        name="view"
        value={view.value}
        options={VIEW_MODES.map((mode) => [mode, LABELS[mode]])}
        onChoose={chooseView}
      />
      {view.value === "samples" && (
        <button type="button" class="quiet" onClick={resample}>
          Resample
        </button>
      )}
      {view.value === "sd" && <MapChooser />}
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
      <ResetView />
      <button type="button" class="quiet" onClick={() => void savePicture()}>
        <DownloadIcon />
        <span>PNG</span>
      </button>
      <button
        type="button"
        class="quiet"
        onClick={() => {
          pictureDialog.value = "figure";
        }}
      >
        Figure…
      </button>
    </div>
  );
}
