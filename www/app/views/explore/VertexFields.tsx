/** Moving a vertex without a pointer. */
import { useSignal } from "@preact/signals";
import { moveVertex, positionOf, takeVertex } from "../../explore/asking";
import { answer, grab, settleSoon } from "../../explore/state";
import { number } from "../../format";
import { slots, unit } from "../../state";

const AXES = ["x", "y", "z"];
/** A step of the arrows, as a share of the model's size. */
const STEP = 0.01;

export function VertexFields() {
  const typed = useSignal("");
  const found = answer.value;
  const size = slots.a.value?.report.size ?? 1;
  const dimension = slots.a.value?.report.dimension ?? 3;
  const step = Number((STEP * size).toPrecision(1));
  const held = grab.value;
  const shown = held ? String(held.vertex) : typed.value;
  const at = found && held ? positionOf(found.explored.shape, held.vertex) : null;
  const move = (axis: number, by: number) => {
    const taken = takeVertex(held?.vertex ?? Number.NaN);
    if (!taken) return;
    moveVertex(taken.to.map((value, i) => (i === axis ? value + by : value)));
    settleSoon();
  };
  return (
    <details class="more vertex-fields">
      <summary>Move a vertex by keys</summary>
      <label class="vertex-number">
        <span>Vertex</span>
        <input
          type="text"
          inputMode="numeric"
          aria-label="Vertex to move"
          value={shown}
          onChange={(event) => {
            typed.value = event.currentTarget.value;
            const number = Number(typed.value);
            if (Number.isInteger(number) && number >= 0) takeVertex(number);
          }}
        />
        <span class="small">or drag it on the shape: “Drag vertices”</span>
      </label>
      {held && at && (
        <ul class="vertex-axes">
          {AXES.slice(0, dimension).map((name, axis) => (
            <li key={name} data-axis-name={name} data-value={at[axis]}>
              <span>
                {name} {number(at[axis] ?? 0)} {unit.value}
              </span>
              <button type="button" onClick={() => move(axis, -step)} aria-label={`${name} less`}>
                −{number(step)}
              </button>
              <button type="button" onClick={() => move(axis, step)} aria-label={`${name} more`}>
                +{number(step)}
              </button>
            </li>
          ))}
        </ul>
      )}
    </details>
  );
}
