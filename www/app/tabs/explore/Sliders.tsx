/** Sliders for the directions of the explored model, in standard deviations. */
import { useComputed, useSignal } from "@preact/signals";
import type { Axes } from "../../../worker/protocol";
import { MOST_SD, REACH_SD } from "../../state/explorer";
import {
  askable,
  coefficients,
  currentAxes,
  setCoefficient,
  settle,
  settleSoon,
  trouble,
} from "../../state/exploring";
import { unit } from "../../state/state";
import { PlayIcon, StopIcon } from "../../ui/icons";
import { play, playing, stopPlaying } from "./playing";
import { missedText, orderSentence, valueText, valueWords } from "./words";

/** Number of sliders that are shown at first. */
const FIRST = 10;

export function Sliders() {
  const all = useSignal(false);
  const axes = currentAxes.value;
  if (!axes) {
    if (trouble.value !== null) return null;
    return (
      <p class="small">{askable.value === null ? "Shown once the comparison is prepared." : ""}</p>
    );
  }
  const total = axes.values.length;
  const shown = all.value ? total : Math.min(total, FIRST);
  return (
    <div class="axes">
      <p class="small">{orderSentence(axes, unit.value)}</p>
      {total === 0 && <p class="small">There are no such directions.</p>}
      <ol>
        {axes.values.slice(0, shown).map((_, axis) => (
          <Axis key={`${axes.space} ${axes.kind} ${axis}`} axes={axes} axis={axis} />
        ))}
      </ol>
      {total > FIRST && (
        <button
          type="button"
          class="as-link"
          onClick={() => {
            all.value = !all.value;
          }}
        >
          {all.value ? `Show the first ${FIRST}` : `Show all ${total}`}
        </button>
      )}
    </div>
  );
}

function Axis({ axes, axis }: { axes: Axes; axis: number }) {
  // Only the slider that moves is rendered again: there may be hundreds.
  const value = useComputed(() => coefficients.value[axis] ?? 0).value;
  const name = `Direction ${axis + 1}`;
  const orders = axes.values[axis] ?? 0;
  const words = valueWords(axes, orders, unit.value);
  const missed = missedText(axes, axis, unit.value);
  const set = (next: number) => {
    stopPlaying();
    setCoefficient(axis, next);
  };
  const reset = () => {
    set(0);
    settle();
  };
  return (
    <li class="axis" data-axis={axis + 1} data-moved={value !== 0}>
      <span class="axis-name" title={words}>
        <strong class="axis-number">{axis + 1}</strong>
        <span>
          {valueText(axes.kind, orders, unit.value)}
          {missed !== null && <small>{missed}</small>}
        </span>
      </span>
      <input
        type="range"
        min={-REACH_SD}
        max={REACH_SD}
        step={0.05}
        value={value}
        aria-label={`${name}, ${words}`}
        aria-valuetext={`${value.toFixed(2)} standard deviations`}
        onInput={(event) => set(Number(event.currentTarget.value))}
        onChange={settleSoon}
        onDblClick={reset}
      />
      <input
        type="text"
        inputMode="text"
        aria-label={`${name} in standard deviations`}
        data-value={value}
        value={value.toFixed(2)}
        onChange={(event) => {
          const typed = numberIn(event.currentTarget.value);
          if (typed === null) {
            event.currentTarget.value = value.toFixed(2);
            return;
          }
          set(typed);
          settle();
        }}
        onDblClick={reset}
        autocomplete="off"
      />
      <PlayButton axis={axis} />
    </li>
  );
}

function PlayButton({ axis }: { axis: number }) {
  const swings = useComputed(() => playing.value?.axis === axis).value;
  const label = `${swings ? "Stop" : "Play"} direction ${axis + 1}`;
  return (
    <button
      type="button"
      class="quiet icon-only"
      aria-label={label}
      title={label}
      onClick={() => (swings ? stopPlaying() : play(axis, false))}
    >
      {swings ? <StopIcon /> : <PlayIcon />}
    </button>
  );
}

/** Reads a typed number, with either minus sign; null if it is none. */
function numberIn(text: string): number | null {
  const typed = Number(text.trim().replace("−", "-").replace(",", "."));
  if (text.trim() === "" || !Number.isFinite(typed)) return null;
  return Math.min(MOST_SD, Math.max(-MOST_SD, typed));
}
