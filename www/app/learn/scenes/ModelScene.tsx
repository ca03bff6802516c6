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

/** σ has no effect on a single model; the engine requires one. */
const SIGMA = SCENE_PARAMS.cloud.sigma.standard;
const SWINGS = [
  { reach: 2, speed: 0.5 },
  { reach: 1.8, speed: 0.32 },
];

/** Scene about a shape model: mean, basis, coefficients, and their probability. */
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
  // Within the drawn part of the plane.
  const within = (value: number) => Math.min(EXTENT, Math.max(-EXTENT, value));
  const to = (point: readonly [number, number]) =>
    autoplay.hold([...point.map(within), ...autoplay.now.slice(2)]);
  const move = (by: readonly [number, number]) => to([first + by[0], second + by[1]]);
  return (
    <>
      <p class="lead">
        A shape model has a <em>mean</em> shape and a few <em>modes</em>, directions in which shapes
        vary. A coefficient for each mode gives a shape; here two of them vary. Drag the round point
        and see its shape.
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
        u₁ and u₂ are the modes of the model, √λ₁ and √λ₂ their standard deviations, which are the
        units of the coefficients. This model has {q} modes. The other {q - 2} have small standard
        deviations, keep the tips on their circle, and are 0 here.
      </p>
      <details class="ask">
        <summary>What do the rings mean, and what is beyond the third?</summary>
        <p>
          A priori the coefficients have the standard normal distribution N(0, I): p(α) is
          proportional to exp(−½‖α‖²), the same in every direction. This is why modes are scaled by
          their standard deviations √λ: a coefficient of the first mode is as probable as the same
          coefficient of the second, though it moves the star further. Shapes beyond the third ring
          are possible, but so improbable that the star no longer looks like those from which the
          model was computed. The paper therefore limits a model to a region around its mean, its{" "}
          <em>allowable domain</em>.
        </p>
      </details>
    </>
  );
}
