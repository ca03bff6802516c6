import type { Side } from "../../../worker/protocol";
import { addModels, chooseFor, removeModel } from "../../models/list/actions";
import { isSame, namesOf } from "../../models/list/order";
import { titleOf } from "../../models/sources";
import {
  addingModels,
  modelList,
  opening,
  partName,
  reopening,
  SIDES,
  type Slot,
  slots,
  sourceKey,
} from "../../state/state";
import { count } from "../../text/format";
import { CloseIcon } from "../../ui/icons";

/** Names of the models of the model list, in its order. */
export function listNames(): string[] {
  return namesOf(modelList.value, titleOf);
}

/** Table of the open models: points, modes, and which two of them are compared. */
export function ModelListTable() {
  const names = listNames();
  return (
    <div class="scrolled-wide">
      <table class="model-list">
        <caption>Open models</caption>
        <thead>
          <tr>
            <th scope="col">Model</th>
            <th scope="col" data-side="a">
              A
            </th>
            <th scope="col" data-side="b">
              B
            </th>
            <th scope="col" class="figure">
              Points
            </th>
            <th scope="col" class="figure">
              Modes
            </th>
            <th scope="col">Unit</th>
            <td />
          </tr>
        </thead>
        <tbody>
          {modelList.value.map((slot, i) => (
            <ModelRow key={names[i]} slot={slot} name={names[i] ?? ""} />
          ))}
        </tbody>
      </table>
    </div>
  );
}

function ModelRow({ slot, name }: { slot: Slot; name: string }) {
  const { report } = slot;
  const compared = SIDES.some((side) => isSame(slot, slots[side].value));
  return (
    <tr>
      <th scope="row">
        <span class="model-list-name" title={`${name}: ${report.format}`}>
          {name}
        </span>
        <OtherParts slot={slot} name={name} />
      </th>
      {SIDES.map((side) => (
        <Chosen key={side} side={side} slot={slot} name={name} />
      ))}
      <td class="figure">{count(report.points)}</td>
      <td class="figure">{count(report.modes)}</td>
      <td>{report.unit}</td>
      <td class="figure">
        {!compared && (
          <button
            type="button"
            class="quiet icon-only"
            aria-label={`Close ${name}`}
            title={`Close ${name}`}
            onClick={(event) => {
              // The button disappears with its row: the focus moves to the next row.
              const row = event.currentTarget.closest("tr");
              const next = row?.nextElementSibling ?? row?.previousElementSibling;
              removeModel(slot);
              next?.querySelector<HTMLElement>("button.icon-only, input")?.focus();
            }}
          >
            <CloseIcon />
          </button>
        )}
      </td>
    </tr>
  );
}

function Chosen({ side, slot, name }: { side: Side; slot: Slot; name: string }) {
  const busy = opening.a.value !== null || opening.b.value !== null || reopening.value;
  return (
    <td data-side={side}>
      <label class="choice">
        <input
          type="radio"
          name={`model-list-${side}`}
          aria-label={`${name} as ${side.toUpperCase()}`}
          checked={isSame(slot, slots[side].value)}
          disabled={busy}
          onChange={() => void chooseFor(side, slot)}
        />
      </label>
    </td>
  );
}

/** Models of the same file that are not on the model list. */
function OtherParts({ slot, name }: { slot: Slot; name: string }) {
  const key = sourceKey(slot.source);
  const others = slot.parts.filter(
    (part) => !modelList.value.some((one) => sourceKey(one.source) === key && one.part === part),
  );
  // Shown once for each file, at its first model.
  const leads = modelList.value.find((one) => sourceKey(one.source) === key) === slot;
  if (others.length === 0 || !leads) return null;
  return (
    <span class="other-parts">
      {others.map((part) => (
        <button
          key={part}
          type="button"
          class="as-link"
          disabled={addingModels.value !== null}
          aria-label={`Add ${partName(part)} of ${name}`}
          onClick={() => void addModels([{ source: slot.source, part, reading: slot.reading }])}
        >
          + {partName(part)}
        </button>
      ))}
    </span>
  );
}
