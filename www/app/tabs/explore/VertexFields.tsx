/** Moves a vertex of the explored shape by buttons, for use without a pointer. */

import { answer, settleSoon } from "../../state/exploring";
import { compared, slots, unit, vertex } from "../../state/state";
import { number } from "../../text/format";
import { NumberField } from "../../ui/NumberField";
import { moveVertex, positionOf, takeVertex } from "./asking";
import { stopPlaying } from "./playing";

const AXES = ["x", "y", "z"];
/** A step of the arrows, as a share of the model's size. */
const STEP = 0.01;

export function VertexFields() {
  const shape = answer.value?.explored.shape;
  const report = slots.a.value?.report;
  if (!shape || !report) return null;
  const chosen = vertex.value;
  const at = chosen === null ? null : positionOf(shape, chosen);
  const step = Number((STEP * report.size).toPrecision(1));
  const word = compared.value ? "compared point" : "vertex";
  return (
    <details class="more vertex-fields">
      <summary>Move a {word} by keys</summary>
      <p class="small">
        Shows the shape with the smallest change in standard deviations that has the {word} at this
        position. With a pointer: “Drag vertices” above the shapes.
      </p>
      <NumberField
        label={compared.value ? "Compared point" : "Vertex"}
        value={chosen}
        least={0}
        most={shape.length / report.dimension - 1}
        placeholder="number"
        onChange={(next) => {
          vertex.value = next;
        }}
      />
      {chosen !== null && at && (
        <ul class="vertex-axes">
          {at.map((value, axis) => (
            <li key={AXES[axis]} data-axis-name={AXES[axis]} data-value={value}>
              <span class="num">
                {AXES[axis]} {number(value)} {unit.value}
              </span>
              <StepButton axis={axis} vertex={chosen} by={-step} />
              <StepButton axis={axis} vertex={chosen} by={step} />
            </li>
          ))}
        </ul>
      )}
    </details>
  );
}

function StepButton({ axis, vertex, by }: { axis: number; vertex: number; by: number }) {
  return (
    <button
      type="button"
      aria-label={`${AXES[axis]} ${by > 0 ? "more" : "less"}`}
      onClick={() => {
        stopPlaying();
        const taken = takeVertex(vertex);
        if (!taken) return;
        moveVertex(taken.to.map((value, i) => (i === axis ? value + by : value)));
        settleSoon();
      }}
    >
      {by > 0 ? "+" : "−"}
      {number(Math.abs(by))}
    </button>
  );
}
