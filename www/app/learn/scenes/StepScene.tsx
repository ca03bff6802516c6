import { useMemo } from "preact/hooks";
import { count, number } from "../../text/format";
import { useFrames } from "../clock";
import { useSceneKeys } from "../keys";
import { PlayBar, Slider } from "../parts/controls";
import {
  AnyPairChoice,
  ChainSlider,
  SamplerChoice,
  SeedField,
  SideChoice,
  SigmaSlider,
} from "../sampling/Controls";
import { isTold, SPEEDS } from "../sampling/pacing";
import { useOwn, useSession } from "../sampling/session";
import { WALKS } from "../scenes";
import { params, resetScene, setParams } from "../state";
import { ChainNumbers, Traces } from "./step/ChainNumbers";
import { Pictures } from "./step/Pictures";
import { Questions } from "./step/Questions";
import { StepRun, type StepValues } from "./step/run";
import { Working } from "./step/Working";
import "./samplers.css";

/** Number of chains and speed that show whether chains agree. */
const MANY = { chains: 8, speed: 1000 };
/** σ for stars: ten times the paper’s. */
const STAR_SIGMA = 0.03;

/** Scene with single Metropolis–Hastings steps, then many chains. */
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
        The probability density of a shape is only known <em>relative to that of another</em>. That
        is enough: propose a step, compare, accept or reject. The chain then spends most of its
        steps at shapes of both models.
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
          <h3 id="chains-title">Has it converged? Run several chains</h3>
          <button type="button" onClick={many}>
            {MANY.chains} chains, {count(MANY.speed)} steps a second
          </button>
        </header>
        <div class="scene-body">
          <Traces run={run} chains={chains} />
          <div class="scene-side">
            <ChainNumbers run={run} />
          </div>
        </div>
      </section>
      <div class="scene-settings">
        <AnyPairChoice value={pair} starSigma={STAR_SIGMA} onChange={change} />
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

function LastStep({ run, corrected }: { run: StepRun; corrected: boolean }) {
  return <Working step={run.decisions.value.at(-1)} told={run.told.value} corrected={corrected} />;
}
