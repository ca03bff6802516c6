import type { Prediction } from "../../worker/protocol";
import { parsePositive } from "../state/settings";
import {
  change,
  outOfDate,
  preview,
  recommended,
  result,
  run,
  settings,
  slots,
  tried,
  unit,
} from "../state/state";
import { length, number, percent } from "../text/format";
import { Metric } from "../ui/Phrase";
import { TypedField } from "../ui/TypedField";
import { ReachCurve } from "./ReachCurve";
import { axisOf, middleSigma, SigmaRange, shownSigma } from "./SigmaRange";

/** Sets the tolerance σ, by number or slider, with the distance that is predicted for it and the curve of what it leaves outside. */
export function SigmaField() {
  const now = settings.value;
  const shown = recommended.value;
  const typed = tried.value ?? now.sigma;
  return (
    <>
      <TypedField
        label="Tolerance σ"
        value={typed === null ? "" : String(typed)}
        standard=""
        placeholder={shown === null ? "auto" : number(shown)}
        suffix={unit.value}
        standardWord="recommended"
        parse={parsePositive}
        onChange={(sigma) => change({ sigma })}
        wrong={`a positive length in ${unit.value}`}
        help="How far from a model, on average per point, a shape may lie and still count as one it can make. A larger σ widens the intersection and leaves less in the differences."
      />
      <SigmaSlider />
      <Expected />
      <ReachCurve />
    </>
  );
}

function SigmaSlider() {
  const [middle, sigma] = [middleSigma.value, shownSigma.value];
  if (middle === null || sigma === null) return null;
  const [low, high] = axisOf(middle);
  return (
    <div class="sigma-slider" data-tick={recommended.value !== null}>
      <SigmaRange
        label="Tolerance σ, on a logarithmic scale"
        words={valueText(sigma)}
        middle={middle}
        sigma={sigma}
      />
      <span class="sigma-ends" aria-hidden="true">
        <span>{number(low)}</span>
        {recommended.value !== null && <span class="sigma-tick">recommended</span>}
        <span>{number(high)}</span>
      </span>
    </div>
  );
}

function valueText(sigma: number): string {
  const text = `${number(sigma)} ${unit.value}`;
  const theirs = recommended.value;
  if (theirs === null) return text;
  if (Math.abs(sigma / theirs - 1) < 0.005) return `${text}, the recommended value`;
  return `${text}, ${number(sigma / theirs)} times the recommended value`;
}

/** Distance and dimensions predicted for the σ of the slider; dashes until they are computed. */
function Expected() {
  const report = result.value?.report;
  if (!report) return null;
  const size = report.models.a.size;
  if (tried.value !== null || outOfDate.value) {
    const sigma = tried.value ?? settings.value.sigma ?? recommended.value;
    const ahead = foreseen(sigma);
    return (
      <p class="sigma-line" data-preview={ahead === null ? "none" : ahead.sigma}>
        predicted distance{" "}
        <strong data-expected="distance" data-value={ahead?.distance}>
          {ahead === null ? "–" : length(ahead.distance, unit.value)}
        </strong>{" "}
        · σ is {sigma === null ? "–" : percent(sigma / size)} of the size of A · acts on{" "}
        {ahead === null ? "–" : dimensionsText(ahead.effectiveDimensions)}
      </p>
    );
  }
  const found = report.intersection.tolerance;
  if (!found || !slots.a.value) return null;
  const path = "intersection.tolerance";
  return (
    <p class="sigma-line">
      predicted distance{" "}
      <Metric
        path={`${path}.predicted`}
        value={found.predicted}
        text={length(found.predicted, unit.value)}
      />{" "}
      · σ is{" "}
      <Metric path={`${path}.relative`} value={found.relative} text={percent(found.relative)} /> of
      the size of A · acts on{" "}
      <Metric
        path={`${path}.effectiveDimensions`}
        value={found.effectiveDimensions}
        text={dimensionsText(found.effectiveDimensions)}
      />
    </p>
  );
}

/** The prediction for this σ; while the slider moves, the latest one. */
function foreseen(sigma: number | null): Prediction | null {
  const latest = preview.value;
  if (latest === null || sigma === null) return null;
  if (tried.value !== null && run.value === null) return latest;
  return Math.abs(latest.sigma / sigma - 1) < 1e-6 ? latest : null;
}

function dimensionsText(dimensions: number): string {
  const text = dimensions < 10 ? dimensions.toFixed(1) : String(Math.round(dimensions));
  return `${text} dimension${text === "1.0" ? "" : "s"}`;
}
