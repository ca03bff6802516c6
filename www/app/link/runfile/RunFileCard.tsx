import { opening, outOfDate, run, SIDES, slots } from "../../state/state";
import { CloseIcon } from "../../ui/icons";
import { showNotice } from "../../ui/Notices";
import type { ExpectedRun } from "./expected";
import {
  advice,
  awaited,
  forgetRunFile,
  repeated,
  reproduced,
  sameModels,
  useSettingsAnyway,
} from "./run";

/** Notice about a run file or a link: its models are missing, or its settings are in use. */
export function RunFileCard() {
  if (awaited.value) return <Awaited run={awaited.value} />;
  const shown = repeated.value;
  if (!shown) return null;
  return (
    <div class="run-file" role="status" aria-label={label(shown)} data-about="taken">
      {shown.file === null ? (
        <p>
          With the settings of the link.
          {sameModels.value && " Both models are the ones that it was made with."}
        </p>
      ) : (
        <p>
          With the settings of “{shown.file}”
          {shown.engine !== null && `, made by engine ${shown.engine}`}. <Numbers />
        </p>
      )}
      <button
        type="button"
        class="quiet icon-only"
        onClick={forgetRunFile}
        aria-label={`Dismiss the ${label(shown).toLowerCase()}`}
      >
        <CloseIcon />
      </button>
    </div>
  );
}

function label({ link }: ExpectedRun): string {
  return link ? "Link" : "Run file";
}

function Awaited({ run }: { run: ExpectedRun }) {
  const empty = SIDES.every((side) => slots[side].value === null);
  // Not while a model is being opened: “these” models would change.
  const complete = SIDES.every((side) => slots[side].value && opening[side].value === null);
  const sentences = [advice.value.a, advice.value.b].flatMap((sentence) => sentence ?? []);
  return (
    <section ref={showNotice} class="run-file" aria-label={label(run)} data-about="awaited">
      <div class="run-file-body">
        <h2>{run.link ? "The link waits for its models" : `“${run.file}” waits for its models`}</h2>
        <div role="alert">
          {sentences.map((sentence) => (
            <p key={sentence}>{sentence}</p>
          ))}
        </div>
        <p class="small">
          {run.link &&
            "A link contains no files: drop the same files anywhere; the page checks that they are the same. "}
          The comparison starts when they are open{!empty && "; until then nothing changes"}.
        </p>
        <div class="card-row">
          {complete && (
            <button type="button" onClick={useSettingsAnyway}>
              Use its settings for these
            </button>
          )}
          <button type="button" class={complete ? "quiet" : ""} onClick={forgetRunFile}>
            Discard
          </button>
        </div>
      </div>
    </section>
  );
}

/** Says whether the result has the same numbers as the report. */
function Numbers() {
  const found = reproduced.value;
  if (found === undefined || run.value || outOfDate.value) return null;
  return found === null ? (
    <strong data-reproduced="true">All numbers are the same as in the report.</strong>
  ) : (
    <strong data-reproduced="false">
      Not all numbers are the same as in the report: {found} differs.
    </strong>
  );
}
