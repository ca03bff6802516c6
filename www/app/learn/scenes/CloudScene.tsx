import { useMemo } from "preact/hooks";
import { count } from "../../text/format";
import { useFrames } from "../clock";
import { PlayBar } from "../parts/controls";
import {
  ChainSlider,
  CountSlider,
  PairChoice,
  SamplerChoice,
  SeedField,
  SigmaSlider,
} from "../sampling/Controls";
import { useGrowing } from "../sampling/growing";
import { LESSON_SAMPLERS, SCENE_PARAMS, STAR_PAIRS } from "../scenes";
import { params, resetScene, setParams } from "../state";
import { FallChart } from "./cloud/FallChart";
import { Numbers } from "./cloud/Numbers";
import { Pictures } from "./cloud/Pictures";
import { Questions } from "./cloud/Questions";
import { CloudRun, type CloudValues, MOST_DRAWS } from "./cloud/run";
import "./samplers.css";

/** Scene with draws of the intersection, the model computed from them, and the known intersection. */
export function CloudScene() {
  const run = useMemo(() => new CloudRun(), []);
  const values = params("cloud").value;
  const { pair, sigma, sampler, chains, seed, draws } = values;
  const { again, toggle } = useGrowing(run, {
    of: [pair, sigma, sampler, chains, seed].join(),
    far: draws,
    standard: SCENE_PARAMS.cloud.draws.standard,
    open: (ask, growing) => run.open(ask, params("cloud").peek(), growing),
    write: (found) => setParams("cloud", { draws: found }),
  });
  useFrames(run.moving, (elapsed) => run.frame(elapsed));
  const change = (part: Partial<CloudValues>) => {
    again();
    setParams("cloud", part);
  };
  return (
    <>
      <p class="lead">
        Thousands of steps give a cloud of draws: stars that both models can make. Principal
        component analysis (PCA) of these draws gives the <em>intersection model</em>. Here the true
        intersection is known: only the first tip moves.
      </p>
      <div class="scene-bar">
        <PlayBar playing={run.playing.value} onToggle={toggle} onReset={resetScene}>
          <span class="dim">{more(run)}</span>
        </PlayBar>
        <SamplerChoice
          value={sampler}
          options={LESSON_SAMPLERS}
          onChange={(next) => change({ sampler: next })}
        />
      </div>
      <Pictures run={run} pair={pair} />
      <div class="scene-body">
        <Fall run={run} />
        <div class="scene-side">
          <Numbers run={run} />
        </div>
      </div>
      <div class="scene-settings">
        <CountSlider
          label="Draws"
          most={MOST_DRAWS}
          value={draws}
          onChange={(next) => change({ draws: next })}
        />
        <ChainSlider value={chains} onChange={(next) => change({ chains: next })} />
        <SigmaSlider
          value={sigma}
          least={0.0003}
          most={1}
          onChange={(next) => change({ sigma: next })}
        />
        <PairChoice value={pair} options={STAR_PAIRS} onChange={(next) => change({ pair: next })} />
        <SeedField value={seed} onChange={(next) => change({ seed: next })} />
      </div>
      <Questions />
    </>
  );
}

const more = (run: CloudRun) =>
  run.playing.value
    ? `${count(run.draws.value)} draws of each model`
    : run.draws.value >= MOST_DRAWS
      ? "20,000 draws: the maximum"
      : `${count(run.draws.value)} draws; “Run” draws four times as many`;

function Fall({ run }: { run: CloudRun }) {
  const found = run.found.value;
  if (!found) return <div class="chart-room" />;
  return <FallChart found={found} most={Math.max(2000, run.draws.value)} />;
}
