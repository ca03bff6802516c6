import { batch } from "@preact/signals";
import {
  DEFINITIONS,
  type DifferencePicture,
  exclusive,
  nearlyTheModel,
} from "../../comparison/words";
import { DIFFERENCES } from "../../state/settings";
import {
  change,
  exaggeration,
  picture,
  result,
  settings,
  settledExaggeration,
  view,
} from "../../state/state";
import { MOST_EXAGGERATION } from "../../state/view";
import { number, percent } from "../../text/format";
import { Phrase } from "../../ui/Phrase";
import { Segments } from "../../ui/Segments";
import { Slider } from "../../ui/Slider";

const PICTURES: DifferencePicture[] = [...DIFFERENCES, "exclusiveModes"];

function shownNow(): DifferencePicture {
  return picture.value === "exclusiveModes" ? "exclusiveModes" : settings.value.difference;
}

function choose(name: DifferencePicture): void {
  // In one change, so that one step of Back undoes it.
  batch(() => {
    if (name === "exclusiveModes") {
      picture.value = name;
      // Each shape shows one mode; the mean shows none of them.
      if (view.value === "mean" || view.value === "contrast") view.value = "samples";
      return;
    }
    picture.value = "draws";
    if (name !== settings.value.difference) {
      change({ difference: name, differenceThreshold: null });
    }
  });
}

/** Chooses the definition of the difference and how much it is exaggerated. */
export function DifferenceBar() {
  const shown = shownNow();
  const report = result.value?.report;
  const same = report ? nearlyTheModel(report) : null;
  return (
    <div class="difference-bar">
      {same && shown === "soft" && (
        <p class="difference-same">
          <Phrase parts={same} />{" "}
          <button type="button" class="as-link" onClick={() => choose("relative")}>
            Show the relative difference
          </button>
        </p>
      )}
      <details>
        <summary>
          <span>
            Difference: <strong>{DEFINITIONS[shown].label}</strong>
            {exaggeration.value > 0 && ` · exaggerated, γ ${exaggeration.value.toFixed(1)}`}
          </span>
        </summary>
        <Segments
          legend="Definition of the difference"
          name="difference"
          value={shown}
          options={PICTURES.map((name) => [name, DEFINITIONS[name].label, DEFINITIONS[name].help])}
          onChoose={choose}
        />
        <p class="small">
          {DEFINITIONS[shown].help} B∖A the other way round.
          {report && shown === "exclusiveModes" && <ExclusiveModes />}
        </p>
        <div class="difference-sliders">
          {shown !== "soft" && shown !== "exclusiveModes" && <Quantile />}
          <Exaggeration />
        </div>
      </details>
    </div>
  );
}

function ExclusiveModes() {
  const report = result.value?.report;
  if (!report) return null;
  return (
    <>
      {(["a", "b"] as const).map((side) => {
        const parts = exclusive(report, side);
        return (
          parts && (
            <span key={side} class="exclusive">
              {" "}
              <Phrase parts={parts} />
            </span>
          )
        );
      })}
    </>
  );
}

/** Slider of the share that a difference leaves out; on release the differences are drawn again. */
function Quantile() {
  const { differenceQuantile, differenceThreshold } = settings.value;
  return (
    <Slider
      label="Leaves out"
      value={100 * differenceQuantile}
      least={0}
      most={99}
      step={1}
      words={`${percent(differenceQuantile)} of the shapes`}
      shown={differenceThreshold === null ? percent(differenceQuantile) : "by threshold"}
      onSettle={(share) => change({ differenceQuantile: share / 100, differenceThreshold: null })}
    />
  );
}

function Exaggeration() {
  return (
    <Slider
      label="Exaggerate"
      value={exaggeration.value}
      least={0}
      most={MOST_EXAGGERATION}
      step={0.1}
      words={
        exaggeration.value === 0
          ? "none"
          : `${number(exaggeration.value, 2)} times what the other model misses is added`
      }
      shown={`γ ${exaggeration.value.toFixed(1)}`}
      onMove={(times) => {
        exaggeration.value = times;
      }}
      onSettle={(times) => {
        batch(() => {
          settledExaggeration.value = times;
          // The contrast has a push of its own.
          if (view.value === "contrast") view.value = "mean";
        });
      }}
    />
  );
}
