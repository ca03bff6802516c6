import { useAsk, useAsked, useDone } from "../asked";
import { useAutoplay } from "../autoplay";
import { useSceneKeys } from "../keys";
import { lissajous, padded } from "../paths";
import { SCENE_PARAMS } from "../scenes";
import { modeCount, shapeAt } from "../shape";
import { params, setParams } from "../state";
import { CoefficientPlane, EXTENT } from "./model/CoefficientPlane";
import { Equation } from "./model/Equation";
import { ModelSide } from "./model/ModelSide";
import { useOwnShapes } from "./model/ownShapes";
import { StarCanvas } from "./model/StarCanvas";
import "./model.css";

/** σ says nothing about one model; it is given because a lesson has one. */
const SIGMA = SCENE_PARAMS.cloud.sigma.standard;
const SWINGS = [
  { reach: 2, speed: 0.5 },
  { reach: 1.8, speed: 0.32 },
];

/** What a shape model is: a mean, a basis, coefficients, and how probable they are. */
export function ModelScene() {
  const { pair, side, coefficients } = params("model").value;
  const ask = useAsk();
  const lesson = useAsked(ask, { ask: "open", pair, sigma: SIGMA });
  const model = lesson.answer?.[side] ?? null;
  const q = model ? modeCount(model) : coefficients.length;
  const autoplay = useAutoplay({
    chosen: coefficients,
    standard: SCENE_PARAMS.model.coefficients.standard,
    limits: SCENE_PARAMS.model.coefficients,
    path: (start, seconds) => lissajous(start, SWINGS, seconds),
    write: (values) => setParams("model", { coefficients: values }),
  });
  const now = padded(autoplay.now, q);
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
  const cloud = useOwnShapes(ask, lesson.answer, side);
  const playing = autoplay.playing.value;
  useDone(lesson.current && field.current && cloud.current && (playing || point.current));
  useSceneKeys(autoplay.toggle, null);
  const [first = 0, second = 0] = now;
  // Not beyond what is drawn of the plane.
  const within = (value: number) => Math.min(EXTENT, Math.max(-EXTENT, value));
  const to = (point: readonly [number, number]) =>
    autoplay.hold([...point.map(within), ...autoplay.now.slice(2)]);
  const move = (by: readonly [number, number]) => to([first + by[0], second + by[1]]);
  return (
    <>
      <p class="lead">
        A shape model is a machine that makes shapes. It knows a <em>mean</em> and a few{" "}
        <em>directions of change</em>; two numbers say how far to go along each. Take hold of the
        round point and see what it makes.
      </p>
      <div class="model-scene" data-side={side}>
        <StarCanvas
          model={model}
          coefficients={now}
          side={side}
          cloud={cloud.answer?.values ?? null}
        />
        <CoefficientPlane
          field={field.answer}
          coefficients={[first, second]}
          side={side}
          moving={playing}
          onMove={move}
          onPoint={to}
          onToggle={autoplay.toggle}
        />
        <ModelSide
          point={point.answer}
          playing={playing}
          onToggle={autoplay.toggle}
          pair={pair}
          side={side}
        />
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
