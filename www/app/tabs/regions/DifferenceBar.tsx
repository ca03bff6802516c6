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
      if (view.value === "mean") view.value = "samples";
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
        <fieldset class="segments">
          <legend class="unseen">Definition of the difference</legend>
          {PICTURES.map((name) => (
            <label key={name} data-on={shown === name} title={DEFINITIONS[name].help}>
              <input
                type="radio"
                name="difference"
                value={name}
                checked={shown === name}
                onChange={() => choose(name)}
              />
              {DEFINITIONS[name].label}
            </label>
          ))}
        </fieldset>
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
    <label class="slider">
      <span>Leaves out</span>
      <input
        type="range"
        min={0}
        max={99}
        step={1}
        value={100 * differenceQuantile}
        aria-valuetext={`${percent(differenceQuantile)} of the shapes`}
        onChange={(event) =>
          change({
            differenceQuantile: Number(event.currentTarget.value) / 100,
            differenceThreshold: null,
          })
        }
      />
      <span class="num">
        {differenceThreshold === null ? percent(differenceQuantile) : "by threshold"}
      </span>
    </label>
  );
}

function Exaggeration() {
  return (
    <label class="slider">
      <span>Exaggerate</span>
      <input
        type="range"
        min={0}
        max={MOST_EXAGGERATION}
        step={0.1}
        value={exaggeration.value}
        aria-valuetext={
          exaggeration.value === 0
            ? "none"
            : `${number(exaggeration.value, 2)} times what the other model misses is added`
        }
        onInput={(event) => {
          exaggeration.value = Number(event.currentTarget.value);
        }}
        onChange={(event) => {
          settledExaggeration.value = Number(event.currentTarget.value);
        }}
      />
      <span class="num">γ {exaggeration.value.toFixed(1)}</span>
    </label>
  );
}
