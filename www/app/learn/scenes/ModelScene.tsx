import { percent } from "../../format";
import { Segments } from "../../views/Segments";
import { useAsk, useAsked, useDone } from "../asked";
import { useSceneKeys } from "../keys";
import { LessonNumber, LessonNumbers, PlayBar } from "../parts/controls";
import { lissajous, padded } from "../paths";
import { useRoam } from "../roam";
import { SCENE_PARAMS, STAR_PAIRS } from "../scenes";
import { modeCount, shapeAt } from "../shape";
import { params, resetScene, setParams } from "../state";
import { Equation } from "./model/Equation";
import { EXTENT, PlaneBoard } from "./model/PlaneBoard";
import { StarBoard } from "./model/StarBoard";
import "../../../styles/learn-model.css";

/** σ says nothing about one model; it is given because a lesson has one. */
const SIGMA = SCENE_PARAMS.cloud.sigma.standard;
const SWINGS = [
  { reach: 2, speed: 0.5 },
  { reach: 1.8, speed: 0.32 },
];
/** Some of the model’s own shapes, for the cloud. */
const OWN_SHAPES = 60;
const LANE = 0;

/** What a shape model is: a mean, a basis, coefficients, and how probable they are. */
export function ModelScene() {
  const { pair, side, coefficients } = params("model").value;
  const ask = useAsk();
  const lesson = useAsked(ask, { ask: "open", pair, sigma: SIGMA });
  const model = lesson.answer?.[side] ?? null;
  const q = model ? modeCount(model) : coefficients.length;
  const roam = useRoam({
    chosen: coefficients,
    standard: SCENE_PARAMS.model.coefficients.standard,
    limits: SCENE_PARAMS.model.coefficients,
    path: (start, seconds) => lissajous(start, SWINGS, seconds),
    write: (values) => setParams("model", { coefficients: values }),
  });
  const now = padded(roam.now, q);
  const point = useAsked(ask, model && { ask: "point", side, coefficients: now }, lesson.answer);
  const field = useAsked(
    ask,
    model && {
      ask: "field",
      of: "prior",
      side,
      modes: [0, 1],
      at: padded([], q),
      extent: EXTENT,
      size: 96,
    },
    lesson.answer,
  );
  const lane = useAsked(
    ask,
    model && {
      ask: "begin",
      lane: LANE,
      target: "prior",
      side,
      sampler: "rejection",
      chains: 1,
      seed: "1",
      burnIn: 0,
    },
    lesson.answer,
  );
  const drawn = useAsked(
    ask,
    lane.current ? { ask: "advance", lane: LANE, steps: OWN_SHAPES, watch: false } : null,
    lane.answer,
  );
  const cloud = useAsked(
    ask,
    drawn.current ? { ask: "shapes", lane: LANE, side, most: OWN_SHAPES } : null,
    drawn.answer,
  );
  const playing = roam.playing.value;
  useDone(lesson.current && field.current && cloud.current && (playing || point.current));
  useSceneKeys(roam.toggle, null);
  const [first = 0, second = 0] = now;
  const move = (by: readonly [number, number]) =>
    roam.hold([first + by[0], second + by[1], ...roam.now.slice(2)]);
  const to = (place: readonly [number, number]) => roam.hold([...place, ...roam.now.slice(2)]);
  const found = point.answer;
  return (
    <>
      <p class="lead">
        A shape model is a machine that makes shapes. It knows a <em>mean</em> and a few{" "}
        <em>directions of change</em>; two numbers say how far to go along each. Take hold of the
        round point and see what it makes.
      </p>
      <div class="model-scene" data-side={side}>
        <StarBoard
          model={model}
          coefficients={now}
          side={side}
          cloud={cloud.answer?.values ?? null}
        />
        <PlaneBoard
          field={field.answer}
          place={[first, second]}
          side={side}
          moving={playing}
          onMove={move}
          onPlace={to}
          onToggle={roam.toggle}
        />
        <div class="scene-side">
          <PlayBar playing={playing} onToggle={roam.toggle} onReset={resetScene} />
          <p class="board-caption" id="model-help">
            Drag the point, or press an arrow key on it: by 0.1, with Shift by 0.5. Home goes to the
            mean.
          </p>
          <LessonNumbers label="The shape in numbers">
            <LessonNumber label="‖α‖, from the mean" metric="point.norm" value={found?.norm} />
            <LessonNumber
              label="log p(α) + const = −½‖α‖²"
              metric="point.logPrior"
              value={found?.logPrior}
            />
          </LessonNumbers>
          <p class="model-claim">
            More plausible than{" "}
            <strong class="num" data-metric="point.plausibility" data-value={found?.plausibility}>
              {found ? percent(found.plausibility) : "–"}
            </strong>{" "}
            of the shapes that this model makes.
          </p>
          <div class="model-choice">
            <label>
              Stars{" "}
              <select
                value={pair}
                onChange={({ currentTarget }) => {
                  const chosen = STAR_PAIRS.find((name) => name === currentTarget.value);
                  if (chosen) setParams("model", { pair: chosen });
                }}
              >
                {STAR_PAIRS.map((name) => (
                  <option key={name} value={name}>
                    pair {name.slice(-1)}
                  </option>
                ))}
              </select>
            </label>
            <Segments
              legend="Which model"
              name="model-side"
              value={side}
              options={[
                ["a", "Model A"],
                ["b", "Model B"],
              ]}
              onChoose={(chosen) => setParams("model", { side: chosen })}
            />
          </div>
        </div>
      </div>
      {model && (
        <Equation model={model} coefficients={now} shape={shapeAt(model, now)} side={side} />
      )}
      <p class="board-caption">
        u₁ and u₂ are the modes of the model, √λ₁ and √λ₂ their standard deviations: coefficients
        count in those. This model has {q} modes. The other {q - 2} bend the tips back onto their
        circle, move little, and stay at 0 here.
      </p>
      <details class="ask">
        <summary>What do the rings say, and what is beyond the third?</summary>
        <p>
          Before anything is measured, coefficients follow the standard normal distribution N(0, I):
          so p(α) falls off as exp(−½‖α‖²), the same in every direction. That is what dividing by
          the standard deviations √λ is for: one step along the first mode is as probable as one
          along the second, though it moves the star further. Nothing forbids a shape beyond the
          third ring; it is only so improbable that the star no longer looks like those that the
          model was learnt from. The paper therefore cuts the model off somewhere and calls what is
          left its <em>allowable domain</em>.
        </p>
      </details>
    </>
  );
}
