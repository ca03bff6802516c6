import { useSignal } from "@preact/signals";
import type { Alignment } from "../../../worker/protocol";
import { matrixCsv, pairsCsv } from "../../models/list/csv";
import {
  cancelMatrix,
  cellOf,
  continueMatrix,
  measure,
  paused,
  progress,
} from "../../models/list/matrix";
import {
  leavesOut,
  MEASURE_NAMES,
  MEASURES,
  type MeasureName,
  rangeOf,
} from "../../models/list/measures";
import { ALIGNMENTS } from "../../state/settings";
import { change, modelList, settings } from "../../state/state";
import { viridisGradient } from "../../text/colormap";
import { saveText } from "../../ui/download";
import { Select } from "../../ui/Select";
import { MatrixTable } from "./MatrixTable";
import { listNames } from "./ModelListTable";

/** Table of one measure for every pair of open models, with its legend and downloads. */
export function Matrix() {
  const shown = MEASURES[measure.value];
  /** The sentence about the cell under the pointer or the focus. */
  const told = useSignal<string | null>(null);
  const range = rangeOf(shown, valuesShown(measure.value));
  return (
    <figure class="matrix" aria-labelledby="matrix-title">
      <div class="toolbar">
        <h3 id="matrix-title">Pair by pair</h3>
        <Select
          label="What the table shows"
          value={measure.value}
          options={MEASURE_NAMES.map((name) => [name, MEASURES[name].label])}
          onChoose={(name) => {
            measure.value = name;
          }}
        />
        <AlignmentChoice />
        {isStale() && <span class="stale-chip">Out of date</span>}
      </div>
      <p class="small">{shown.help}</p>
      <Progress />
      <MatrixTable range={range} tell={(sentence) => (told.value = sentence)} />
      <div class="matrix-foot">
        <Legend range={range} />
        <Save />
      </div>
      <p class="matrix-told">
        {told.value ?? "Choose a cell to open that pair as the comparison."}
      </p>
      <Notes />
    </figure>
  );
}

/** Values of all computed pairs. */
function valuesShown(name: MeasureName): number[] {
  const { value } = MEASURES[name];
  return modelList.value.flatMap((row) =>
    modelList.value.flatMap((column) => {
      const { relation } = cellOf(row, column);
      return relation && !relation.problem ? (value(relation) ?? []) : [];
    }),
  );
}

function isStale(): boolean {
  return modelList.value.some((row) => modelList.value.some((column) => cellOf(row, column).stale));
}

function AlignmentChoice() {
  return (
    <Select
      label="Align B to A"
      title="How each pair is aligned before it is compared; the same setting as for A and B"
      value={settings.value.align}
      options={(Object.keys(ALIGNMENTS) as Alignment[]).map((name) => [
        name,
        `Aligned: ${ALIGNMENTS[name].label.toLowerCase()}`,
      ])}
      onChoose={(align) => change({ align })}
    />
  );
}

function Save() {
  const names = listNames();
  const models = modelList.value;
  const relation = (row: number, column: number) => {
    const [a, b] = [models[row], models[column]];
    const cell = a && b ? cellOf(a, b) : null;
    return cell === null || cell.stale ? null : cell.relation;
  };
  const units = models.map(({ report }) => report.unit);
  return (
    <fieldset class="download-row">
      <legend class="unseen">Save the table</legend>
      <button
        type="button"
        title="The table as it is shown, unrounded"
        onClick={() =>
          saveText(
            `shapevenn-${measure.value}.csv`,
            matrixCsv(names, relation, measure.value),
            "text/csv",
          )
        }
      >
        Table .csv
      </button>
      <button
        type="button"
        title="A line for each pair, with every measure, unrounded"
        onClick={() =>
          saveText("shapevenn-pairs.csv", pairsCsv(names, units, relation), "text/csv")
        }
      >
        All measures .csv
      </button>
    </fieldset>
  );
}

function Progress() {
  const { done, of } = progress.value;
  if (done === of) return null;
  return (
    <div class="working">
      <p class="run-state">
        {paused.value ? "Stopped at" : "Computing"} {done} of {of} pairs
      </p>
      <progress class="bar" value={done} max={of} aria-label="Computed pairs" />
      {paused.value ? (
        <button type="button" onClick={continueMatrix}>
          Continue
        </button>
      ) : (
        <button type="button" onClick={cancelMatrix}>
          Cancel<span class="unseen"> computing the table</span>
        </button>
      )}
    </div>
  );
}

function Legend({ range: [low, high] }: { range: [number, number] }) {
  const { label, text, unit } = MEASURES[measure.value];
  const units = new Set(modelList.value.map(({ report }) => report.unit));
  const length = units.size === 1 ? ([...units][0] ?? "") : "";
  const end = (value: number) => text(value, length);
  return (
    <div class="color-bar" role="img" aria-label={`Colours: ${end(low)} to ${end(high)}`}>
      <span class="color-bar-label">
        {label}
        {unit === "rad" && ", rad"}
      </span>
      <span class="num">{end(low)}</span>
      <span class="ramp" style={{ background: viridisGradient() }} />
      <span class="num">{end(high)}</span>
    </div>
  );
}

/** Notes about the numbers of the table: settings, units, and pairs that cannot be compared. */
function Notes() {
  const names = listNames();
  const units = new Set(modelList.value.map(({ report }) => report.unit));
  const problems = modelList.value.flatMap((row, i) =>
    modelList.value.flatMap((column, j) => {
      const problem = cellOf(row, column).relation?.problem;
      return problem ? { pair: `${names[i]} as A, ${names[j]} as B`, ...problem } : [];
    }),
  );
  return (
    <>
      {leavesOut(settings.value) && (
        <p class="small">
          The settings of A or B alone (units, modes, points) do not apply to the pairs of the
          table.
        </p>
      )}
      {units.size > 1 && (
        <p class="small">
          The models are in different units ({[...units].join(", ")}); lengths are not converted.
        </p>
      )}
      {problems.length > 0 && (
        <details class="more">
          <summary>
            {problems.length === 1
              ? "One pair cannot be compared"
              : `${problems.length} pairs cannot be compared`}
          </summary>
          <ul class="problems">
            {problems.map(({ pair, message }) => (
              <li key={pair}>
                <strong>{pair}:</strong> {message}
              </li>
            ))}
          </ul>
        </details>
      )}
    </>
  );
}
