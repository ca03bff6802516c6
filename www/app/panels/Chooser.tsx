import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Side } from "../../worker/protocol";
import { openEvery } from "../models/list/actions";
import { choosing, openChosen } from "../models/opening";
import { type NamedSource, nameOf } from "../models/sources";
import { SIDES, slots, sourceKey } from "../state/state";

/** Dialog that asks which of several dropped models are compared as A and B. */
export function Chooser() {
  const models = choosing.value;
  const [first] = models ?? [];
  // Every question gets a new dialog.
  return models && first && <Dialog key={sourceKey(first.source)} models={models} />;
}

const KEEP = "keep";

function Dialog({ models }: { models: NamedSource[] }) {
  const dialog = useRef<HTMLDialogElement>(null);
  const chosen = useSignal<Record<Side, string>>({ a: "0", b: "1" });
  useEffect(() => dialog.current?.showModal(), []);
  // The close event arrives later; another drop may have opened a new question by then.
  const close = () => {
    if (choosing.peek() === models) choosing.value = null;
  };
  const source = (side: Side) => models[Number(chosen.value[side])]?.source ?? null;
  const nothing = SIDES.every((side) => chosen.value[side] === KEEP);
  return (
    <dialog ref={dialog} class="chooser-dialog" aria-labelledby="chooser-title" onClose={close}>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          void openChosen(source("a"), source("b"));
        }}
      >
        <h2 id="chooser-title">Which two models are compared?</h2>
        <p>{sentence(models)}</p>
        {SIDES.map((side) => (
          <label key={side} class="chooser-side" data-side={side}>
            <span class="letter">{side.toUpperCase()}</span>
            <select
              aria-label={`Model ${side.toUpperCase()}`}
              value={chosen.value[side]}
              onChange={(event) => {
                chosen.value = { ...chosen.value, [side]: event.currentTarget.value };
              }}
            >
              {models.map(({ name }, i) => (
                <option key={String(i)} value={String(i)}>
                  {name}
                </option>
              ))}
              <option value={KEEP}>stays {present(side)}</option>
            </select>
          </label>
        ))}
        <div class="card-row">
          <button type="submit" class="primary" disabled={nothing}>
            Open
          </button>
          <button
            type="button"
            onClick={() => void openEvery(models, source("a"), source("b"))}
            title="Opens all of them, compares these two, and shows a table of all pairs"
          >
            All: show the table
          </button>
          <button type="button" class="quiet" onClick={close}>
            Cancel
          </button>
        </div>
      </form>
    </dialog>
  );
}

function present(side: Side): string {
  const source = slots[side].value?.source;
  return source ? nameOf(source) : "empty";
}

const MOST_NAMED = 6;

function sentence(models: NamedSource[]): string {
  const names = models.map(({ name }) => `“${name}”`);
  const named = names.slice(0, MOST_NAMED).join(", ");
  const more = names.length > MOST_NAMED ? ` and ${names.length - MOST_NAMED} more` : "";
  return `${models.length} models were found: ${named}${more}.`;
}
