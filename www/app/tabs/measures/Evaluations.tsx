import type { Evaluation, Side } from "../../../worker/protocol";
import {
  type Evaluated,
  evaluate,
  evaluated,
  evaluating,
  placement,
  trainingFiles,
} from "../../comparison/evaluating";
import { evaluationSentence, methodSentence, PLACEMENTS } from "../../comparison/measured";
import { SIDES, slotKey, slots } from "../../state/state";
import { number } from "../../text/format";
import { type Curve, CurveChart } from "../../ui/Curves";
import { DataTable } from "../../ui/DataTable";
import { FileButton } from "../../ui/FileButton";
import { Select } from "../../ui/Select";

/** Computes generalization and specificity of each model, with test shapes or with its training shapes. */
export function Evaluations() {
  return (
    <section class="evaluations" aria-label="Generalization and specificity">
      <h3>Generalization and specificity</h3>
      <p class="small">
        Generalization: how close a model comes to shapes that it was not computed from.
        Specificity: how close its random shapes are to real ones. Both by the number of modes
        (Davies), and both need shapes: meshes or landmarks with the model’s points in the same
        order.
      </p>
      <Select
        label="How test shapes are placed"
        value={placement.value}
        options={(["fit", "mean", "given"] as const).map((one) => [
          one,
          `Test shapes are ${PLACEMENTS[one]}`,
        ])}
        onChoose={(one) => {
          placement.value = one;
        }}
      />
      <div class="charts">
        {SIDES.map((side) => (
          <OfSide key={side} side={side} />
        ))}
      </div>
    </section>
  );
}

function OfSide({ side }: { side: Side }) {
  const slot = slots[side].value;
  const name = side.toUpperCase();
  const busy = evaluating[side].value;
  const training = trainingFiles(side);
  const found = evaluated[side].value;
  const old = found !== null && (slot === null || slotKey(slot) !== found.key);
  return (
    <section class="half evaluation" data-side={side} aria-label={`Test of model ${name}`}>
      <div class="evaluation-buttons">
        <FileButton
          label={`Test shapes for model ${name}`}
          disabled={slot === null || busy}
          onFiles={(files) => void evaluate(side, files, false)}
        >
          Test shapes for {name}…
        </FileButton>
        <FileButton
          className="as-link"
          label={`Folder of test shapes for model ${name}`}
          folder
          disabled={slot === null || busy}
          onFiles={(files) => void evaluate(side, files, false)}
        >
          Folder…<span class="unseen"> of test shapes for {name}</span>
        </FileButton>
        {training && (
          <button
            type="button"
            class="as-link"
            disabled={busy}
            onClick={() => void evaluate(side, training, true)}
          >
            Use the training shapes of {name}
          </button>
        )}
      </div>
      {busy && <p class="small">Reading the shapes and testing {name}…</p>}
      {found && (
        <div data-stale={old || busy}>
          {old && <span class="stale-chip">Of the previous model</span>}
          <Found found={found} side={side} />
        </div>
      )}
    </section>
  );
}

function Found({ found, side }: { found: Evaluated; side: Side }) {
  const { evaluation, problem } = found;
  if (problem) {
    return (
      <div class="notice" role="alert">
        <p>
          <span class="notice-message">{problem.message}</span>{" "}
          <span class="notice-hint">{problem.hint}</span>
        </p>
      </div>
    );
  }
  return evaluation && <EvaluationChart evaluation={evaluation} unit={found.unit} side={side} />;
}

interface ChartProps {
  evaluation: Evaluation;
  unit: string;
  side: Side;
}

function EvaluationChart({ evaluation, unit, side }: ChartProps) {
  const name = side.toUpperCase();
  const { modes, generalization, generalizationError, specificity, specificityError } = evaluation;
  const curves: Curve[] = [
    {
      key: "generalization",
      label: "generalization",
      mark: "circle",
      values: generalization,
      at: modes,
      errors: generalizationError,
    },
    {
      key: "specificity",
      label: "specificity",
      mark: "square",
      values: specificity,
      at: modes,
      errors: specificityError,
    },
  ];
  const sentence = evaluationSentence(evaluation, name, unit);
  return (
    <CurveChart
      name={`evaluation-${side}`}
      title={`Model ${name} tested`}
      about={`${methodSentence(evaluation)} ${sentence} Bars: ± one standard error.`}
      label={`Generalization and specificity of ${name} by the number of modes. ${sentence}`}
      plot={{
        height: 216,
        curves,
        acrossName: "modes",
        upName: `mean distance per vertex, ${unit}`,
      }}
      table={() => (
        <DataTable
          file={`evaluation-${side}`}
          caption={`Generalization and specificity of ${name}, ${unit}, with standard errors`}
          corner="Modes"
          columns={[
            { title: "Generalization" },
            { title: "SE of gen.", show: (value) => number(value, 2) },
            { title: "Specificity" },
            { title: "SE of spec.", show: (value) => number(value, 2) },
          ]}
          rows={modes.map((mode, i) => ({
            head: mode,
            values: [
              generalization[i],
              generalizationError[i],
              specificity[i],
              specificityError[i],
            ],
          }))}
        />
      )}
    />
  );
}
