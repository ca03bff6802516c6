import { useMemo } from "preact/hooks";
import { count } from "../../text/format";
import { AdviceLine } from "../../ui/Chart";
import { useFrames } from "../clock";
import { PlayBar } from "../parts/controls";
import {
  AnyPairChoice,
  ChainSlider,
  CountSlider,
  SeedField,
  SideChoice,
  SigmaSlider,
} from "../sampling/Controls";
import { useGrowing } from "../sampling/growing";
import { BREAKS, SCENE_PARAMS } from "../scenes";
import { params, resetScene, setParams } from "../state";
import { BREAK_WORDS, raceVerdict } from "./race/broken";
import { ChainGroups } from "./race/ChainGroups";
import { Distance, Squares } from "./race/Numbers";
import { Questions } from "./race/Questions";
import { RaceTable } from "./race/RaceTable";
import { MOST_STEPS, RaceRun, type RaceValues } from "./race/run";
import { SquareChart } from "./race/SquareChart";
import "./samplers.css";

const STAR_SIGMA = 0.003;

/** Scene that compares samplers by their effective draws, and shows four ways in which sampling fails. */
export function RaceScene() {
  const run = useMemo(() => new RaceRun(), []);
  const values = params("race").value;
  const { pair, sigma, side, chains, seed, steps, break: what } = values;
  const { again, toggle } = useGrowing(run, {
    of: [pair, sigma, side, chains, seed, what].join(),
    far: steps,
    standard: SCENE_PARAMS.race.steps.standard,
    open: (ask, growing) => run.open(ask, params("race").peek(), growing),
    write: (found) => setParams("race", { steps: found }),
  });
  useFrames(run.playing, (elapsed) => run.frame(elapsed));
  const change = (part: Partial<RaceValues>) => {
    again();
    setParams("race", part);
  };
  return (
    <>
      <p class="lead">
        The paper’s random walk makes many small steps. Other samplers use the gradient, or propose
        from a Gaussian fit. Which one has the most <em>effective</em> draws for the same number of
        evaluations of the density?
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
        <ChainGroups run={run} />
        {what === "scaling" && (
          <SquareChart curve={run.curve.value} most={Math.max(1, run.target.value)} />
        )}
      </div>
      <div class="scene-body">
        <div class="race-results">
          <RaceTable runners={run.runners.value} diagnostics={run.diagnostics.value} />
        </div>
        <div class="scene-side">
          <AdviceLine
            advice={{
              ...raceVerdict(what, run.diagnostics.value, run.models.value?.sigma ?? sigma),
              chain: null,
            }}
          />
          {what === "scaling" ? <Squares run={run} /> : <Distance run={run} />}
        </div>
      </div>
      <div class="scene-settings">
        <CountSlider
          label="Steps"
          most={MOST_STEPS}
          value={steps}
          onChange={(next) => change({ steps: next })}
        />
        <ChainSlider value={chains} onChange={(next) => change({ chains: next })} />
        <SigmaSlider
          value={sigma}
          least={0.0003}
          most={3}
          onChange={(next) => change({ sigma: next })}
        />
        <AnyPairChoice value={pair} starSigma={STAR_SIGMA} onChange={change} />
        <SideChoice value={side} onChange={(next) => change({ side: next })} />
        <SeedField value={seed} onChange={(next) => change({ seed: next })} />
      </div>
      <Questions />
    </>
  );
}
