/** Panel of the explorer: sets a shape along directions of one model and shows how close the other model comes. */
import type { AxesKind } from "../../../worker/protocol";
import { KINDS, MOST_MAGNIFY, SPACES } from "../../state/explorer";
import {
  choose,
  chooseKind,
  chooseSpace,
  currentAxes,
  explore,
  explorer,
  settle,
  toMean,
  toRandom,
  trouble,
} from "../../state/exploring";
import { outOfDate } from "../../state/state";
import { number } from "../../text/format";
import { play, playing, stopPlaying } from "./playing";
import { Sliders } from "./Sliders";
import { VertexFields } from "./VertexFields";
import { kindLabel, SIGNS } from "./words";

export function Explorer() {
  const { space, kind } = explorer.value;
  const swings = playing.value;
  return (
    <section class="explorer" aria-label="Explorer" data-stale={outOfDate.value}>
      <fieldset class="segments">
        <legend class="unseen">Model whose shape is set</legend>
        {SPACES.map((name) => (
          <label key={name} data-on={space === name} data-space={name}>
            <input
              type="radio"
              name="driven"
              value={name}
              checked={space === name}
              onChange={() => chooseSpace(name)}
            />
            Drive {SIGNS[name]}
          </label>
        ))}
      </fieldset>
      <select
        aria-label="Along which directions"
        value={kind}
        onChange={(event) => chooseKind(event.currentTarget.value as AxesKind)}
      >
        {(space === "intersection" ? (["modes"] as const) : KINDS).map((name) => (
          <option key={name} value={name}>
            {kindLabel(name, space)}
          </option>
        ))}
      </select>
      {trouble.value && <p class="warning">{trouble.value}</p>}
      <div class="explorer-buttons">
        <button type="button" onClick={calmly(toMean)}>
          Mean
        </button>
        <button type="button" onClick={calmly(toRandom)}>
          Random
        </button>
        <button
          type="button"
          aria-pressed={swings?.all ?? false}
          disabled={(currentAxes.value?.values.length ?? 0) === 0}
          onClick={() => (swings ? stopPlaying() : play(0, true))}
        >
          {swings ? "Stop" : "Play all"}
        </button>
      </div>
      {kind === "angles" && <Morph />}
      <Magnify />
      <Sliders />
      <VertexFields />
    </section>
  );
}

/** Wraps a choice so that it stops the animation. */
function calmly(action: () => void): () => void {
  return () => {
    stopPlaying();
    action();
  };
}

/** Sets how many times deviations from the mean are drawn. */
function Magnify() {
  const { magnify } = explorer.value;
  return (
    <label class="slider">
      <span>Magnify</span>
      <input
        type="range"
        min={1}
        max={MOST_MAGNIFY}
        step={0.5}
        value={magnify}
        aria-valuetext={`deviations from the mean ${number(magnify, 2)} times as large`}
        onInput={(event) => explore({ magnify: Number(event.currentTarget.value) })}
        onChange={settle}
        onDblClick={() => choose({ magnify: 1 })}
      />
      <span class="num">{magnify}×</span>
    </label>
  );
}

/** Slider from A's shape to B's shape of a principal angle. */
function Morph() {
  const { morph } = explorer.value;
  return (
    <label class="slider">
      <span>Morph</span>
      <input
        type="range"
        min={0}
        max={1}
        step={0.01}
        value={morph}
        aria-label="From A’s shape to B’s"
        aria-valuetext={`${Math.round(100 * morph)} % of the way from A to B`}
        onInput={(event) => explore({ morph: Number(event.currentTarget.value) })}
        onChange={settle}
      />
      <span class="num">{Math.round(100 * morph)} % B</span>
    </label>
  );
}
