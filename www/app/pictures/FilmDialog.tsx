import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { wasAborted } from "../../worker/engine-errors";
import { result } from "../state/state";
import { bytes } from "../text/format";
import { Check } from "../ui/Check";
import { saveBlob } from "../ui/download";
import { Modal } from "../ui/Modal";
import { NumberField } from "../ui/NumberField";
import { Segments } from "../ui/Segments";
import { Select } from "../ui/Select";
import { Slider } from "../ui/Slider";
import { canRecord, encodeGif, recordWebm } from "./encode";
import {
  FIRST_FILM,
  type FilmOptions,
  type Format,
  filmName,
  filmSentence,
  SECONDS,
  SIZES,
  type Subject,
} from "./film";
import { closeOffscreen } from "./offscreen";
import { type Reel, reelOf, stillOf } from "./reel";

const SUBJECTS: [Subject, string][] = [
  ["a", "Mode of A"],
  ["intersection", "Mode of A∩B"],
  ["b", "Mode of B"],
  ["morph", "From A to B"],
];

const BACKGROUNDS: [FilmOptions["background"], string][] = [
  ["white", "White"],
  ["dark", "Dark"],
];

/** Milliseconds between updates of the progress bar: rendering the page slows the animation down. */
const PROGRESS_STEP = 0.02;

/** Dialog that saves an animation of a mode, or of the change from A to B, as GIF or WebM. */
export function FilmDialog({ onClose }: { onClose: () => void }) {
  const options = useSignal<FilmOptions>({ ...FIRST_FILM, format: canRecord() ? "webm" : "gif" });
  const set = (part: Partial<FilmOptions>) => {
    options.value = { ...options.value, ...part };
  };
  const making = useSignal<{ share: number; controller: AbortController } | null>(null);
  const said = useSignal("");
  const { subject, format, size, seconds, loops, label, mode, background } = options.value;
  const report = result.value?.report;
  useEffect(
    () => () => {
      making.peek()?.controller.abort();
      closeOffscreen();
    },
    [],
  );

  const save = async () => {
    const controller = new AbortController();
    making.value = { share: 0, controller };
    said.value = "";
    const wanted = options.peek();
    const onProgress = (share: number) => {
      const shown = making.peek()?.share ?? 1;
      if (share - shown >= PROGRESS_STEP) making.value = { share, controller };
    };
    try {
      const reel = await reelOf(controller.signal, wanted);
      const encode = wanted.format === "gif" ? encodeGif : recordWebm;
      const blob = await encode(controller.signal, reel, wanted, onProgress);
      saveBlob(filmName(wanted), blob);
      said.value = `Saved ${filmName(wanted)}, ${bytes(blob.size)}.`;
    } catch (thrown) {
      if (wasAborted(thrown)) said.value = "Cancelled; nothing was saved.";
      else said.value = thrown instanceof Error ? thrown.message : String(thrown);
    }
    making.value = null;
  };

  return (
    <Modal title="Animation" onClose={onClose}>
      <Segments
        legend="What moves"
        name="film-subject"
        value={subject}
        options={SUBJECTS}
        onChoose={(chosen) => set({ subject: chosen, mode: 0 })}
      />
      <Still options={options.value} />
      <div class="modal-fields">
        {subject !== "morph" && (
          <NumberField
            label="Mode"
            value={mode + 1}
            least={1}
            most={modesOf(subject)}
            onChange={(number) => number !== null && set({ mode: number - 1 })}
          />
        )}
        <NumberField
          label="Width, pixels"
          value={size}
          least={SIZES.least}
          most={SIZES.most}
          onChange={(number) => number !== null && set({ size: number })}
        />
        <NumberField
          label="Seconds"
          value={seconds}
          least={SECONDS.least}
          most={SECONDS.most}
          onChange={(number) => number !== null && set({ seconds: number })}
        />
        <label class="number-field">
          <span>Format</span>
          <select
            value={format}
            onChange={(event) => set({ format: event.currentTarget.value as Format })}
          >
            <option value="gif">GIF</option>
            <option value="webm" disabled={!canRecord()}>
              WebM{canRecord() ? "" : " (not in this browser)"}
            </option>
          </select>
        </label>
        <label class="number-field">
          <span>Background</span>
          <Select
            value={background}
            options={BACKGROUNDS}
            onChoose={(chosen) => set({ background: chosen })}
          />
        </label>
        <Check
          title="The animation ends where it began, and a GIF repeats"
          checked={loops}
          onChange={(checked) => set({ loops: checked })}
        >
          Loop
        </Check>
        <Check checked={label} onChange={(checked) => set({ label: checked })}>
          Label
        </Check>
      </div>
      {report && <p class="small">{filmSentence(options.value, report)}</p>}
      <div class="modal-foot">
        {making.value ? (
          <>
            <progress aria-label="Saving the animation" max={1} value={making.value.share} />
            <button type="button" onClick={() => making.value?.controller.abort()}>
              Cancel
            </button>
          </>
        ) : (
          <>
            <span class="small" role="status">
              {said.value}
            </span>
            <button type="button" class="primary" disabled={!report} onClick={() => void save()}>
              Save {format === "gif" ? "GIF" : "WebM"}
            </button>
          </>
        )}
      </div>
    </Modal>
  );
}

function modesOf(subject: Exclude<Subject, "morph">): number {
  const report = result.value?.report;
  if (!report) return 1;
  if (subject === "intersection") return report.intersection.modes;
  const { modes } = report.settings;
  return Math.min(modes ?? Number.POSITIVE_INFINITY, report.models[subject].modes);
}

/** Preview of one moment of the animation, chosen by a slider. */
function Still({ options }: { options: FilmOptions }) {
  const place = useRef<HTMLDivElement>(null);
  const reel = useSignal<Reel | null>(null);
  const moment = useSignal(0);
  const problem = useSignal("");
  const { subject, mode, label, background, loops } = options;
  useEffect(() => {
    const controller = new AbortController();
    reelOf(controller.signal, { ...options, size: 480 }).then(
      (found) => {
        reel.value = found;
        problem.value = "";
      },
      (thrown: unknown) => {
        if (!wasAborted(thrown)) problem.value = thrown instanceof Error ? thrown.message : "";
      },
    );
    return () => controller.abort();
  }, [subject, mode, label, background, loops]);
  const [found, at] = [reel.value, moment.value];
  useEffect(() => {
    if (found) place.current?.replaceChildren(stillOf(found, at));
  }, [found, at]);
  return (
    <div class="film-preview">
      <div ref={place} role="img" aria-label="One moment of the animation" />
      {problem.value && <p class="small">{problem.value}</p>}
      <Slider
        label="Moment"
        value={at}
        least={0}
        most={1}
        step={0.01}
        words={`${Math.round(100 * at)} % of its time`}
        shown={`${Math.round(100 * at)}\u202f%`}
        onMove={(share) => {
          moment.value = share;
        }}
      />
    </div>
  );
}
