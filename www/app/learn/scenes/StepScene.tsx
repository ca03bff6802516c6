import { useMemo } from "preact/hooks";
import { count, number, percent } from "../../format";
import { AdviceLine } from "../../views/Chart";
import { Board } from "../canvas/Board";
import { useFrames } from "../clock";
import { useSceneKeys } from "../keys";
import { LessonNumber, LessonNumbers, PlayBar, Slider } from "../parts/controls";
import {
  ChainSlider,
  PairChoice,
  SamplerChoice,
  SeedField,
  SideChoice,
  SigmaSlider,
} from "../sampling/Controls";
import { isTold, SPEEDS } from "../sampling/pacing";
import { useOwn, useSession } from "../sampling/session";
import { chainVerdict } from "../sampling/verdicts";
import { PAIRS, WALKS } from "../scenes";
import { params, resetScene, setParams } from "../state";
import { drawNear, drawWalk, type Shown } from "./step/draw";
import { Mixture } from "./step/Mixture";
import { EXTENT, StepRun, type StepValues } from "./step/run";
import { drawTraces } from "./step/traces";
import { Working } from "./step/Working";
import "../../../styles/learn-samplers.css";

/** As many chains, and as fast, as it takes to see whether they agree. */
const MANY = { chains: 8, speed: 1000 };
/** What may differ by so much is called near, on stars of ten points and on planes of one. */
const USUAL_SIGMA = { planes: 0.3, stars: 0.03 };

/** One Metropolis–Hastings step at a time, then many chains. */
export function StepScene() {
  const run = useMemo(() => new StepRun(), []);
  const values = params("step").value;
  const { revision, own } = useOwn(values.steps);
  const { pair, sigma, side, sampler, chains, seed, speed } = values;
  useSession([pair, sigma, side, sampler, chains, seed, revision].join(), (ask) =>
    run.open(ask, params("step").peek(), write),
  );
  useFrames(run.moving, (elapsed) => run.frame(elapsed, params("step").peek().speed));
  const write = (steps: number) => {
    own(steps);
    setParams("step", { steps });
  };
  const change = (part: Partial<StepValues>) => {
    own(0);
    setParams("step", { ...part, steps: 0 });
  };
  const toggle = () => {
    if (run.playing.peek()) void run.pause().then(write);
    else run.run(write);
  };
  const one = () => void run.one().then(write);
  useSceneKeys(toggle, one);
  const many = () => change(MANY);
  return (
    <>
      <p class="lead">
        How plausible a shape is can only be told <em>compared with another</em>. That is enough:
        propose a step, compare, decide. The walk then stays longest where shapes of both models
        are.
      </p>
      <div class="scene-bar">
        <PlayBar playing={run.playing.value} onToggle={toggle} onStep={one} onReset={resetScene} />
        <Slider
          label="Speed"
          least={SPEEDS.least}
          most={SPEEDS.most}
          step={0}
          logarithmic
          value={speed}
          show={(value) => `${number(value, 2)}/s`}
          onChange={(value) => setParams("step", { speed: value })}
        />
      </div>
      <div class="scene-body step-body">
        <div class="step-boards">
          <Pictures run={run} slow={isTold(speed)} chains={chains} />
        </div>
        <div class="scene-side">
          <LastStep run={run} corrected={sampler === "paper-corrected"} />
        </div>
      </div>
      <section class="step-chains" aria-labelledby="chains-title">
        <header class="step-chains-head">
          <h3 id="chains-title">Can it be trusted? Let several chains run</h3>
          <button type="button" onClick={many}>
            {MANY.chains} chains, {count(MANY.speed)} steps a second
          </button>
        </header>
        <div class="scene-body">
          <Traces run={run} chains={chains} />
          <div class="scene-side">
            <Figures run={run} />
          </div>
        </div>
      </section>
      <div class="scene-settings">
        <PairChoice
          value={pair}
          options={PAIRS}
          onChange={(next) =>
            change({ pair: next, sigma: USUAL_SIGMA[next === "planes" ? "planes" : "stars"] })
          }
        />
        <SideChoice value={side} onChange={(next) => change({ side: next })} />
        <SamplerChoice
          value={sampler}
          options={WALKS}
          onChange={(next) => change({ sampler: next })}
        />
        <SeedField value={seed} onChange={(next) => change({ seed: next })} />
        <SigmaSlider
          value={sigma}
          least={0.003}
          most={3}
          onChange={(next) => change({ sigma: next })}
        />
        <ChainSlider value={chains} onChange={(next) => change({ chains: next })} />
      </div>
      <Questions />
    </>
  );
}

function Pictures({ run, slow, chains }: { run: StepRun; slow: boolean; chains: number }) {
  const image = run.image.value;
  const decisions = run.decisions.value;
  const shown: Shown | null = image && {
    image,
    trail: run.trail,
    decisions,
    told: run.told.value,
    slow,
  };
  return (
    <>
      <figure>
        <Board
          label={`Density of the intersection over two coefficients from −${EXTENT} to ${EXTENT} standard deviations, and ${chains === 1 ? "a chain that walks" : `${chains} chains that walk`} on it`}
          aspect={1}
          draw={(pen, size, palette) => shown && drawWalk(pen, size, palette, shown)}
        />
        <figcaption class="board-caption">
          Bright: plausible in A, near B, and plausible there too. Dashed circles: 1, 2, 3 SD of A’s
          own shapes.
        </figcaption>
      </figure>
      <figure class="step-near">
        <Board
          label="The last step under a magnifier: the state, the circles or the ray of the proposal, the proposal, and whether it was accepted"
          aspect={1}
          draw={(pen, size, palette) => shown && drawNear(pen, size, palette, shown)}
        />
        <figcaption class="board-caption">
          Magnified. Grey: proposal; <b class="good">✓</b> accepted; <b class="bad">✕</b> rejected.
          <Mixture part={decisions.at(-1)?.part} />
        </figcaption>
      </figure>
    </>
  );
}

function LastStep({ run, corrected }: { run: StepRun; corrected: boolean }) {
  return <Working step={run.decisions.value.at(-1)} told={run.told.value} corrected={corrected} />;
}

function Traces({ run, chains }: { run: StepRun; chains: number }) {
  const step = run.progress.value?.step ?? 0;
  return (
    <figure>
      <Board
        label={`Traces of both coefficients over the last steps, up to step ${step}, a line for each chain`}
        aspect={0.34}
        draw={(pen, size, palette) => {
          if (run.trail.length > 1) drawTraces(pen, size, palette, run.trail, chains);
        }}
      />
      <figcaption class="board-caption">
        The last 300 steps of α₁ and α₂; dashed: ±2 SD. Chains that have converged cannot be told
        apart.
      </figcaption>
    </figure>
  );
}

function Figures({ run }: { run: StepRun }) {
  const figures = run.figures.value;
  const progress = run.progress.value;
  return (
    <>
      <LessonNumbers label="What the chains say of themselves">
        <LessonNumber
          label="steps of each chain"
          metric="settings.steps"
          value={progress?.step ?? 0}
          show={count}
        />
        <LessonNumber
          label="accepted"
          metric="figures.acceptance"
          value={figures?.acceptance}
          show={percent}
        />
        <LessonNumber
          label="R-hat"
          metric="figures.rHatMax"
          value={figures?.rHatMax}
          show={(value) => number(value, 4)}
        />
        <LessonNumber
          label="effective draws"
          metric="figures.essBulkMin"
          value={figures?.essBulkMin}
          note={figures ? `of ${count(figures.draws)}` : undefined}
        />
      </LessonNumbers>
      {figures && <AdviceLine advice={{ ...chainVerdict(figures), chain: null }} />}
    </>
  );
}

function Questions() {
  return (
    <div class="scene-questions">
      <details>
        <summary>Why is a worse proposal ever accepted?</summary>
        <p>
          If it never were, the walk would climb to the top and stay there: it would find the most
          plausible shape, not how much shapes may vary. Accepting a proposal that is half as
          plausible half of the time makes the time spent at each shape proportional to its density.
        </p>
      </details>
      <details>
        <summary>What does the Hastings factor put right?</summary>
        <p>
          The scaling move draws a new length ‖α′‖ for the same direction. A step from long to short
          lands on a smaller sphere, so it is met more often than its way back. The factor
          (‖α′‖/‖α‖)<sup>q−1</sup> makes up for it. The paper leaves it out: its walk shrinks.
          Choose “as published” and watch the last line but one, or break it in the race.
        </p>
      </details>
      <details>
        <summary>Why so many steps for so few effective draws?</summary>
        <p>
          Each state is near the one before it, so that a new one says little new. The effective
          sample size is how many independent draws would know the mean as well.
        </p>
      </details>
    </div>
  );
}
