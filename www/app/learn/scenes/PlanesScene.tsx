import type { LessonAsk, Side } from "../../../worker/protocol";
import { degrees } from "../../text/format";
import { Segments } from "../../ui/Segments";
import { useAsk, useAsked, useDone } from "../asked";
import { useAutoplay } from "../autoplay";
import { useSceneKeys } from "../keys";
import { bounded } from "../params";
import { LessonNumber, LessonNumbers, PlayBar } from "../parts/controls";
import { swung } from "../paths";
import { SCENE_PARAMS, type SceneValues } from "../scenes";
import { params, resetScene, setParams } from "../state";
import { EXTENT } from "./planes/draw";
import { Factors } from "./planes/Factors";
import { Sliders } from "./planes/Sliders";
import { SpaceCanvas } from "./planes/SpaceCanvas";
import type { Flat } from "./planes/space";
import { angleWords, TRIES, whatToSee } from "./planes/words";
import "./planes.css";

const SCHEMA = SCENE_PARAMS.planes;
/** The view oscillates, since a single view shows little of the space. */
const SWAY = { reach: 0.5, speed: 0.45 };
const SIZE = 96;
/** Bounds of the point: the drawn part of its plane. */
const SHEET = { least: -EXTENT, most: EXTENT, digits: SCHEMA.coefficients.digits };
const set = (part: Partial<SceneValues<"planes">>) => setParams("planes", part);

/** Scene with two planes in space, the smallest case of two models: distance, projection and likelihoods of a point. */
export function PlanesScene() {
  const { tilt, shift, lift, sigma, side, coefficients, turn } = params("planes").value;
  const ask = useAsk();
  const lesson = useAsked(ask, { ask: "open", pair: "planes", sigma, tilt, shift, lift });
  const models = lesson.answer;
  const field = (of: Side): Extract<LessonAsk, { ask: "field" }> | null =>
    models && {
      ask: "field",
      of: "intersection",
      side: of,
      modes: [0, 1],
      at: [0, 0],
      extent: EXTENT,
      size: SIZE,
    };
  const fieldA = useAsked(ask, field("a"), models);
  const fieldB = useAsked(ask, field("b"), models);
  const [first = 0, second = 0] = coefficients;
  const alpha: Flat = [first, second];
  const point = useAsked(ask, models && { ask: "point", side, coefficients: [...alpha] }, models);
  const autoplay = useAutoplay({
    chosen: turn,
    standard: SCHEMA.turn.standard,
    limits: SCHEMA.turn,
    path: ([yaw = 0, pitch = 0], seconds) => [yaw + swung(0, SWAY, seconds), pitch],
    write: (values) => set({ turn: values }),
  });
  useDone(lesson.current && fieldA.current && fieldB.current && point.current);
  useSceneKeys(autoplay.toggle, null);
  const to = (moved: Flat) => {
    // Moving the point stops the motion of the view.
    if (autoplay.playing.peek()) autoplay.toggle();
    set({ coefficients: moved.map((value) => bounded(SHEET, value)) });
  };
  const found = point.answer;
  const [yaw = 0, pitch = 0] = autoplay.now;
  const playing = autoplay.playing.value;
  return (
    <>
      <p class="lead">
        Take models so small that they can be drawn: one point, two modes. The shapes of a model are
        then a <em>plane</em>, and its plausible shapes an <em>ellipse</em>. Two models are two
        planes: which points can both make?
      </p>
      <div class="scene-body planes-body">
        <div class="planes-board">
          {models ? (
            <SpaceCanvas
              models={models}
              fields={{ a: fieldA.answer, b: fieldB.answer }}
              side={side}
              coefficients={alpha}
              point={found}
              turn={[yaw, pitch]}
              onPoint={to}
              onTurn={autoplay.hold}
              onRun={autoplay.toggle}
            />
          ) : (
            <div class="board planes-wait" />
          )}
          <p class="board-caption" id="planes-help">
            Drag x in its plane, anything else turns the view. Arrow keys move x by 0.1, with Shift
            by 0.5, Home to the mean; J L I K turn.
          </p>
        </div>
        <div class="scene-side">
          <div class="planes-top">
            <PlayBar playing={playing} onToggle={autoplay.toggle} onReset={resetScene} />
            <Segments
              legend="Whose point is x"
              name="planes-side"
              value={side}
              options={[
                ["a", "x in A"],
                ["b", "x in B"],
              ]}
              onChoose={(chosen) => set({ side: chosen })}
            />
          </div>
          <LessonNumbers label="The point in numbers">
            <LessonNumber
              label="Distance d(x′, x)"
              metric="point.distance"
              value={found?.distance}
            />
            <LessonNumber label="From the mean, ‖α‖" metric="point.norm" value={found?.norm} />
          </LessonNumbers>
          <Factors point={found} side={side} />
          <Sliders {...{ sigma, tilt, shift, lift }} />
          <p class="board-caption">
            Principal angles of the two planes:{" "}
            {models?.angles.map((angle, i) => (
              <span key={i} class="num" data-metric={`angles.${i}`} data-value={angle}>
                {i > 0 && ", "}
                {degrees(angle)}
              </span>
            ))}
            . {models && angleWords(models.angles)}
          </p>
        </div>
        <div class="planes-below">
          <p class="planes-see">{whatToSee({ tilt, lift, sigma })}</p>
          <fieldset class="planes-tries">
            <legend class="unseen">Try</legend>
            {TRIES.map(([name, lie]) => (
              <button key={name} type="button" onClick={() => set(lie)}>
                {name}
              </button>
            ))}
          </fieldset>
        </div>
      </div>
      <details class="ask">
        <summary>Why is I, the common line, not all that the method looks for?</summary>
        <p>
          Two ellipses in different planes meet in a segment of a line, I = Q₁ ∩ Q₂. Real models,
          with thousands of points and noise, have no exact intersection: the probability that a
          shape lies exactly in both is zero. So the paper uses I<sub>ε</sub>: points of one ellipse
          whose nearest point of the other model is closer than ε. The bright band is its soft
          version, with σ instead of ε. It lies on <em>both</em> planes, and the method samples from
          both and pools the draws.
        </p>
      </details>
    </>
  );
}
