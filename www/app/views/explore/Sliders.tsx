/** One slider for every direction of the model that is driven. */
import { useSignal } from "@preact/signals";
import { MOST_SD, REACH_SD, rounded } from "../../explore/codec";
import { play, playing, stopPlaying } from "../../explore/playing";
import { coefficients, currentAxes, setCoefficient, settle, settleSoon } from "../../explore/state";
import { orderSentence, valueText, valueWords } from "../../explore/words";
import { unit } from "../../state";

/** How many are shown at first. */
const FIRST = 10;

export function Sliders() {
  const all = useSignal(false);
  const axes = currentAxes.value;
  if (!axes) return <p class="small">The directions are shown once the comparison is prepared.</p>;
  const total = axes.values.length;
  const shown = all.value ? total : Math.min(total, FIRST);
  return (
    <div class="axes">
      <p class="small">{orderSentence(axes, unit.value)}</p>
      {total === 0 && <p class="small">There is no such direction.</p>}
      <ol>
        {axes.values.slice(0, shown).map((value, axis) => (
          <Axis
            key={axis}
            axis={axis}
            ordered={valueText(axes.kind, value, unit.value)}
            words={valueWords(axes, value, unit.value)}
          />
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

function Axis({ axis, ordered, words }: { axis: number; ordered: string; words: string }) {
  const value = coefficients.value[axis] ?? 0;
  const swings = playing.value?.axis === axis;
  const name = `Direction ${axis + 1}`;
  const reset = () => {
    setCoefficient(axis, 0);
    settle();
  };
  return (
    <li class="axis" data-axis={axis + 1} data-moved={value !== 0}>
      <span class="axis-name" title={words}>
        <strong>{axis + 1}</strong> <span class="dim">{ordered}</span>
      </span>
      <input
        type="range"
        min={-REACH_SD}
        max={REACH_SD}
        step={0.05}
        value={value}
        aria-label={`${name}, ${words}`}
        aria-valuetext={`${value.toFixed(2)} standard deviations`}
        onInput={(event) => {
          stopPlaying();
          setCoefficient(axis, Number(event.currentTarget.value));
        }}
        onChange={settleSoon}
        onDblClick={reset}
      />
      <input
        type="text"
        inputMode="decimal"
        aria-label={`${name} in standard deviations`}
        value={value.toFixed(2)}
        onChange={(event) => {
          const typed = Number(event.currentTarget.value.replace("−", "-").replace(",", "."));
          if (!Number.isFinite(typed)) {
            event.currentTarget.value = value.toFixed(2);
            return;
          }
          setCoefficient(axis, rounded(Math.min(MOST_SD, Math.max(-MOST_SD, typed))));
          settle();
        }}
        onDblClick={reset}
      />
      <button
        type="button"
        class="quiet icon-only"
        aria-label={swings ? `Stop direction ${axis + 1}` : `Play direction ${axis + 1}`}
        aria-pressed={swings}
        onClick={() => (swings ? stopPlaying() : play(axis, false))}
      >
        {swings ? "■" : "▶"}
      </button>
    </li>
  );
}
