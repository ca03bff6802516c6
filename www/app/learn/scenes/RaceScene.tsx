import { useMemo, useRef } from "preact/hooks";
import { count, number } from "../../format";
import { AdviceLine } from "../../views/Chart";
import { Board } from "../canvas/Board";
import { still, useFrames } from "../clock";
import { useSceneKeys } from "../keys";
import { LessonNumber, LessonNumbers, PlayBar, Slider } from "../parts/controls";
import { ChainSlider, PairChoice, SeedField, SideChoice, SigmaSlider } from "../sampling/Controls";
import { SAMPLER_NAMES } from "../sampling/names";
import { useOwn, useSession } from "../sampling/session";
import { BREAKS, PAIRS, SCENE_PARAMS } from "../scenes";
import { params, resetScene, setParams } from "../state";
import { BREAK_WORDS, raceVerdict } from "./race/broken";
import { drawRunner, type Scenery } from "./race/draw";
import { RaceTable } from "./race/RaceTable";
import { MOST_STEPS, RaceRun, type RaceValues, type Runner } from "./race/run";
import { SquareChart } from "./race/SquareChart";
import "../../../styles/learn-samplers.css";

const USUAL_SIGMA = { planes: 0.3, stars: 0.003 };

/** Samplers that race for effective draws, and four ways to go wrong. */
export function RaceScene() {
  const run = useMemo(() => new RaceRun(), []);
  const values = params("race").value;
  const { revision, own } = useOwn(values.steps);
  const { pair, sigma, side, chains, seed, steps, break: what } = values;
  // A link that says how far the race is shows that; otherwise it is run before the eye.
  const grows = useRef(steps === SCENE_PARAMS.race.steps.standard);
  useSession([pair, sigma, side, chains, seed, what, revision].join(), async (ask) => {
    const growing = grows.current && !still.peek();
    grows.current = false;
    await run.open(ask, params("race").peek(), growing);
  });
  useFrames(run.playing, (elapsed) => run.frame(elapsed));
  const change = (part: Partial<RaceValues>) => {
    grows.current = true;
    setParams("race", part);
  };
  const write = (found: number) => {
    if (found === 0) return;
    own(found);
    setParams("race", { steps: found });
  };
  const toggle = () => {
    if (run.playing.peek()) void run.pause().then(write);
    else run.run(write);
  };
  useSceneKeys(toggle, null);
  return (
    <>
      <p class="lead">
        The paper’s walk takes many small steps. Others look at the gradient, or propose from a
        Gaussian fit. Same target, same work: who brings home the most <em>effective</em> draws?
      </p>
      <fieldset class="race-breaks">
        <legend>Break it</legend>
        {BREAKS.map((name) => (
          <button
            key={name}
            type="button"
            aria-pressed={what === name}
            onClick={() => change({ break: name })}
          >
            {BREAK_WORDS[name].name}
          </button>
        ))}
      </fieldset>
      <div class="scene-bar">
        <PlayBar playing={run.playing.value} onToggle={toggle} onReset={resetScene}>
          <span class="dim">{BREAK_WORDS[what].about}</span>
          <span class="num race-step">
            step {count(run.step.value)} of {count(run.target.value)}
          </span>
        </PlayBar>
      </div>
      <div class="race-pictures" data-break={what}>
        <Lanes run={run} />
        {what === "scaling" && (
          <SquareChart curve={run.curve.value} most={Math.max(1, run.target.value)} />
        )}
      </div>
      <div class="scene-body">
        <div class="race-results">
          <RaceTable runners={run.runners.value} figures={run.figures.value} />
        </div>
        <div class="scene-side">
          <AdviceLine
            advice={{
              ...raceVerdict(what, run.figures.value, run.models.value?.sigma ?? sigma),
              chain: null,
            }}
          />
          {what === "scaling" ? <Squares run={run} /> : <Distance run={run} />}
        </div>
      </div>
      <div class="scene-settings">
        <Slider
          label="Steps"
          least={16}
          most={MOST_STEPS}
          step={0}
          logarithmic
          value={steps}
          show={count}
          onChange={(next) => change({ steps: Math.round(next) })}
        />
        <ChainSlider value={chains} onChange={(next) => change({ chains: next })} />
        <SigmaSlider
          value={sigma}
          least={0.0003}
          most={3}
          onChange={(next) => change({ sigma: next })}
        />
        <PairChoice
          value={pair}
          options={PAIRS}
          onChange={(next) =>
            change({ pair: next, sigma: USUAL_SIGMA[next === "planes" ? "planes" : "stars"] })
          }
        />
        <SideChoice value={side} onChange={(next) => change({ side: next })} />
        <SeedField value={seed} onChange={(next) => change({ seed: next })} />
      </div>
      <Questions />
    </>
  );
}

function Lanes({ run }: { run: RaceRun }) {
  // Where they are now.
  run.step.value;
  const [image, view, models] = [run.image.value, run.view.value, run.models.value];
  const { side, break: what } = params("race").value;
  const fit = models && what !== "scaling" ? models.fits[side] : null;
  const scenery = image && view && { image, view, fit };
  return (
    <div class="race-lanes" data-count={run.runners.value.length}>
      {run.runners.value.map((runner) => (
        <Lane key={runner.sampler} runner={runner} scenery={scenery} />
      ))}
    </div>
  );
}

interface LaneProps {
  runner: Runner;
  scenery: Scenery | null;
}

function Lane({ runner, scenery }: LaneProps) {
  return (
    <figure>
      <Board
        label={`${SAMPLER_NAMES[runner.sampler]}: its chains over the first two coefficients`}
        aspect={1}
        draw={(pen, size, palette) => {
          if (scenery) drawRunner(pen, size, palette, runner, scenery);
        }}
      />
      <figcaption>{SAMPLER_NAMES[runner.sampler]}</figcaption>
    </figure>
  );
}

/** E‖α‖²/q of both walks: the one number that the scaling move breaks. */
function Squares({ run }: { run: RaceRun }) {
  const [published, corrected] = run.figures.value;
  return (
    <LessonNumbers label="E‖α‖²/q of the walks">
      <LessonNumber
        label="E‖α‖²/q, published"
        metric="race.0.figures.meanSquare"
        value={published?.meanSquare}
        show={(value) => number(value)}
      />
      <LessonNumber
        label="E‖α‖²/q, corrected"
        metric="race.1.figures.meanSquare"
        value={corrected?.meanSquare}
        show={(value) => number(value)}
      />
    </LessonNumbers>
  );
}

/** How far the draws of the last runner are from the other model, beside what σ allows. */
function Distance({ run }: { run: RaceRun }) {
  const lane = run.figures.value.length - 1;
  const sigma = run.models.value?.sigma;
  return (
    <LessonNumbers label="Distance of the draws to the other model">
      <LessonNumber
        label="mean d, independence"
        metric={`race.${lane}.figures.meanDistance`}
        value={run.figures.value[lane]?.meanDistance}
        note={
          sigma === undefined
            ? undefined
            : `σ is ${number(sigma)}: about as much is as it should be`
        }
      />
    </LessonNumbers>
  );
}

function Questions() {
  return (
    <div class="scene-questions">
      <details>
        <summary>Which of the four breaks does R-hat notice, and which not?</summary>
        <p>
          It notices chains that disagree: a σ far too small. It cannot notice that all chains agree
          on the wrong law (uncorrected scaling), that models were never aligned, or, with one
          chain, what that chain has not seen.
        </p>
      </details>
      <details>
        <summary>Why does the independence sampler win here, and when would it lose?</summary>
        <p>
          The intersection posterior is nearly Gaussian, and its fit costs a few iterations. Where a
          target is far from Gaussian, as the difference is, a fit says nothing of it and nearly all
          proposals would be rejected.
        </p>
      </details>
    </div>
  );
}
