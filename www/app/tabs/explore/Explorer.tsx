/** Panel of the explorer: sets a shape along directions of one model and shows how close the other model comes. */
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
import { Segments } from "../../ui/Segments";
import { Select } from "../../ui/Select";
import { Slider } from "../../ui/Slider";
import { play, playing, stopPlaying } from "./playing";
import { Sliders } from "./Sliders";
import { VertexFields } from "./VertexFields";
import { kindLabel, SIGNS } from "./words";

export function Explorer() {
  const { space, kind } = explorer.value;
  const swings = playing.value;
  return (
    <section class="explorer" aria-label="Explorer" data-stale={outOfDate.value}>
      <Segments
        legend="Model whose shape is set"
        name="driven"
        value={space}
        options={SPACES.map((name) => [name, `Drive ${SIGNS[name]}`])}
        onChoose={chooseSpace}
      />
      <Select
        label="Along which directions"
        value={kind}
        options={(space === "intersection" ? (["modes"] as const) : KINDS).map((name) => [
          name,
          kindLabel(name, space),
        ])}
        onChoose={chooseKind}
      />
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
    <Slider
      label="Magnify"
      value={magnify}
      least={1}
      most={MOST_MAGNIFY}
      step={0.5}
      words={`deviations from the mean ${number(magnify, 2)} times as large`}
      shown={`${magnify}×`}
      onMove={(times) => explore({ magnify: times })}
      onSettle={settle}
      onReset={() => choose({ magnify: 1 })}
    />
  );
}

/** Slider from A's shape to B's shape of a principal angle. */
function Morph() {
  const { morph } = explorer.value;
  return (
    <Slider
      label="Morph"
      name="From A’s shape to B’s"
      value={morph}
      least={0}
      most={1}
      step={0.01}
      words={`${Math.round(100 * morph)} % of the way from A to B`}
      shown={`${Math.round(100 * morph)} % B`}
      onMove={(share) => explore({ morph: share })}
      onSettle={settle}
    />
  );
}
