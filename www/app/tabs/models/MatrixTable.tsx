import { useSignal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { comparePair } from "../../models/list/actions";
import { colourOf, moved } from "../../models/list/cells";
import { cellOf, measure } from "../../models/list/matrix";
import { MEASURES } from "../../models/list/measures";
import { isSame } from "../../models/list/order";
import { modelList, type Slot, slots } from "../../state/state";
import { length } from "../../text/format";
import { listNames } from "./ModelListTable";

interface Props {
  range: readonly [number, number];
  /** Sets the sentence about the cell under the pointer or the focus. */
  tell: (sentence: string | null) => void;
}

/** The cells of the table: rows are A, columns are B. Tab reaches one cell, arrow keys go from cell to cell. */
export function MatrixTable({ range, tell }: Props) {
  const names = listNames();
  const models = modelList.value;
  const table = useRef<HTMLTableElement>(null);
  const active = useSignal<[number, number]>([0, 1]);
  const last = models.length - 1;
  const [row, column] = active.value.map((index) => Math.min(index, last));
  const go = (event: KeyboardEvent) => {
    const next = moved([row ?? 0, column ?? 0], event.key, event.ctrlKey || event.metaKey, last);
    if (next === null) return;
    event.preventDefault();
    active.value = next;
    table.current?.querySelector<HTMLElement>(`[data-at="${next.join()}"]`)?.focus();
  };
  return (
    <div class="matrix-box">
      <table ref={table} class="cells" aria-describedby="matrix-keys">
        <caption class="unseen">
          {MEASURES[measure.value].label}: model A in rows, model B in columns
        </caption>
        <thead>
          <tr>
            <td class="corner" aria-hidden="true">
              A ↓ &nbsp;B →
            </td>
            {models.map((model, i) => (
              <Head key={names[i]} slot={model} name={names[i] ?? ""} scope="col" side="b" />
            ))}
          </tr>
        </thead>
        <tbody>
          {models.map((a, i) => (
            <tr key={names[i]}>
              <Head slot={a} name={names[i] ?? ""} scope="row" side="a" />
              {models.map((b, j) => (
                <Cell
                  key={names[j]}
                  {...{ a, b, range, tell }}
                  at={`${i},${j}`}
                  names={[names[i] ?? "", names[j] ?? ""]}
                  onKey={go}
                  inTabOrder={i === row && j === column}
                  onFocus={() => {
                    active.value = [i, j];
                  }}
                />
              ))}
            </tr>
          ))}
        </tbody>
      </table>
      <p id="matrix-keys" class="unseen">
        Arrow keys go from cell to cell, Home and End to the ends of a row; Enter opens the pair.
      </p>
    </div>
  );
}

interface HeadProps {
  slot: Slot;
  name: string;
  scope: "row" | "col";
  side: "a" | "b";
}

/** Name of a row or column, marked if its model is compared now. */
function Head({ slot, name, scope, side }: HeadProps) {
  const compared = isSame(slot, slots[side].value);
  return (
    <th scope={scope} data-side={side} data-compared={compared} title={name}>
      <span class="cell-name">{name}</span>
    </th>
  );
}

/** Opens the pair of a cell and moves the focus to the choice of regions, since the table is then hidden. */
async function compare(a: Slot, b: Slot): Promise<void> {
  await comparePair(a, b);
  await new Promise(requestAnimationFrame);
  const { activeElement, body } = document;
  if (activeElement && activeElement !== body) return;
  document.querySelector<HTMLElement>(".tabs [aria-current]")?.focus({ preventScroll: true });
}

interface CellProps extends Props {
  a: Slot;
  b: Slot;
  names: [string, string];
  at: string;
  inTabOrder: boolean;
  onFocus: () => void;
  onKey: (event: KeyboardEvent) => void;
}

function Cell({ a, b, names, at, range, tell, inTabOrder, onFocus, onKey }: CellProps) {
  const { relation, stale } = cellOf(a, b);
  const shown = MEASURES[measure.value];
  const problem = relation?.problem ?? null;
  const value = relation && !problem ? shown.value(relation) : null;
  const known = value !== null && Number.isFinite(value);
  const text = known ? shown.text(value, a.report.unit) : relation ? "–" : "…";
  const sentence = () => {
    const [row, column] = names;
    if (a === b) return `${row} beside itself.`;
    if (problem) return `${row} as A, ${column} as B: ${problem.message} ${problem.hint}`;
    if (!known) return relation ? `${row}, ${column}: there is no such number.` : null;
    const noise = length(relation?.noise ?? Number.NaN, a.report.unit);
    return shown.sentence(row, column, text, noise);
  };
  const current = isSame(a, slots.a.value) && isSame(b, slots.b.value);
  const colours = known && a !== b ? colourOf(value, range) : null;
  return (
    <td>
      <button
        type="button"
        class="cell"
        data-at={at}
        data-value={known ? value : undefined}
        data-old={stale}
        data-itself={a === b}
        data-problem={problem?.code}
        aria-current={current ? "true" : undefined}
        aria-label={`A ${names[0]}, B ${names[1]}: ${problem ? problem.message : text}${stale ? ", out of date" : ""}`}
        tabIndex={inTabOrder ? 0 : -1}
        style={colours ?? undefined}
        onClick={() => void compare(a, b)}
        onKeyDown={onKey}
        onFocus={() => {
          onFocus();
          tell(sentence());
        }}
        onPointerEnter={() => tell(sentence())}
        onPointerLeave={() => tell(null)}
        onBlur={() => tell(null)}
      >
        {text}
      </button>
    </td>
  );
}
