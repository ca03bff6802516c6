import { useMemo, useRef } from "preact/hooks";
import { count, number } from "../../format";
import { AdviceLine } from "../../views/Chart";
import { Board } from "../canvas/Board";
import { still, useFrames } from "../clock";
import { useSceneKeys } from "../keys";
import { LessonNumber, LessonNumbers, PlayBar, Slider } from "../parts/controls";
import {
  ChainSlider,
  PairChoice,
  SamplerChoice,
  SeedField,
  SigmaSlider,
} from "../sampling/Controls";
import { BOUNDS } from "../sampling/polar";
import { useOwn, useSession } from "../sampling/session";
import { cloudVerdict } from "../sampling/verdicts";
import { LESSON_SAMPLERS, SCENE_PARAMS, STAR_PAIRS } from "../scenes";
import { params, resetScene, setParams } from "../state";
import { drawModel, drawPolar, drawStars } from "./cloud/draw";
import { FallChart } from "./cloud/FallChart";
import { CloudRun, type CloudValues, MOST_DRAWS } from "./cloud/run";
import "../../../styles/learn-samplers.css";

/** Draws of both sides, the model made of them, and the truth. */
export function CloudScene() {
  const run = useMemo(() => new CloudRun(), []);
  const values = params("cloud").value;
  const { revision, own } = useOwn(values.draws);
  const { pair, sigma, sampler, chains, seed, draws } = values;
  // A link that says how many draws there are shows these; otherwise they pile up before the eye.
  const grows = useRef(draws === SCENE_PARAMS.cloud.draws.standard);
  useSession([pair, sigma, sampler, chains, seed, revision].join(), async (ask) => {
    const growing = grows.current && !still.peek();
    grows.current = false;
    await run.open(ask, params("cloud").peek(), growing);
  });
  useFrames(run.moving, (elapsed) => run.frame(elapsed));
  const change = (part: Partial<CloudValues>) => {
    grows.current = true;
    setParams("cloud", part);
  };
  const write = (found: number) => {
    if (found === 0) return;
    own(found);
    setParams("cloud", { draws: found });
  };
  const toggle = () => {
    if (run.playing.peek()) void run.pause().then(write);
    else run.run(write);
  };
  useSceneKeys(toggle, null);
  return (
    <>
      <p class="lead">
        Thousands of steps leave a cloud of stars that both models can make. Principal components of
        that cloud are the <em>intersection model</em>. Here the true one is known: only the first
        tip moves.
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
          <Figures run={run} />
        </div>
      </div>
      <div class="scene-settings">
        <Slider
          label="Draws"
          least={16}
          most={MOST_DRAWS}
          step={0}
          logarithmic
          value={draws}
          show={count}
          onChange={(next) => change({ draws: Math.round(next) })}
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
    ? `${count(run.draws.value)} draws of each side`
    : run.draws.value >= MOST_DRAWS
      ? "20,000 draws: enough"
      : `${count(run.draws.value)} draws; Run draws four times as many`;

function Pictures({ run, pair }: { run: CloudRun; pair: string }) {
  const [models, stars] = [run.models.value, run.stars.value];
  const segments = models?.segments ?? [];
  const length = models ? models.dimension * models.points : 1;
  const bound = BOUNDS[pair] ?? null;
  return (
    <div class="boards cloud-boards">
      <figure>
        <Board
          label="Stars drawn from both sides, one above the other; their first tips as dots"
          aspect={1}
          draw={(pen, size, palette) =>
            stars && drawStars(pen, size, palette, stars, segments, length)
          }
        />
        <figcaption class="board-caption">
          The draws: <b class="side-a">of A, near B</b> and <b class="side-b">of B, near A</b>.
        </figcaption>
      </figure>
      <Swaying run={run} />
      <figure>
        <Board
          label={`Polar histogram of the angles of the five tips; both models can make the first within ${bound ?? "–"} degrees`}
          aspect={1}
          draw={(pen, size, palette) =>
            stars && drawPolar(pen, size, palette, stars, length, bound)
          }
        />
        <figcaption class="board-caption">
          How far each tip turns, as in the paper. Both were made with tip 1 within −{bound}…{bound}
          °.
        </figcaption>
      </figure>
    </div>
  );
}

/** Alone, as it is drawn every frame. */
function Swaying({ run }: { run: CloudRun }) {
  const [models, found] = [run.models.value, run.found.value];
  const sway = still.value ? 1 : run.sway.value;
  return (
    <figure>
      <Board
        label="The model of the draws, solid, and the true intersection, dashed, swaying by two standard deviations along their first mode"
        aspect={1}
        draw={(pen, size, palette) => {
          if (!models || !found) return;
          drawModel(pen, size, palette, found.model, models.truth, models.segments ?? [], sway);
        }}
      />
      <figcaption class="board-caption">
        <b class="side-ab">PCA of the draws</b> and the truth (dashed): mean ± 2 SD of mode 1.
      </figcaption>
    </figure>
  );
}

function Fall({ run }: { run: CloudRun }) {
  const found = run.found.value;
  if (!found) return <div class="chart-room" />;
  return <FallChart found={found} most={Math.max(2000, run.draws.value)} />;
}

function Figures({ run }: { run: CloudRun }) {
  const [found, sides] = [run.found.value, run.figures.value];
  const last = found ? found.predicted.length - 1 : 0;
  const predicted = found?.predicted[last] ?? null;
  return (
    <>
      <LessonNumbers label="The model of the draws beside the truth">
        <LessonNumber
          label="d_G to the truth"
          metric="intersection.grassmann"
          value={found?.grassmann}
        />
        <LessonNumber
          label="expected of noise"
          metric={`intersection.predicted.${last}`}
          value={predicted}
        />
        <LessonNumber
          label="closed form"
          metric="intersection.closedForm"
          value={found?.closedForm}
        />
        <LessonNumber
          label="R-hat, A and B"
          metric="sides.a.rHatMax"
          value={sides?.a.rHatMax}
          show={(value) => number(value, 3)}
          note={
            <span data-metric="sides.b.rHatMax" data-value={sides?.b.rHatMax ?? undefined}>
              {sides?.b.rHatMax == null ? "–" : number(sides.b.rHatMax, 3)} of B
            </span>
          }
        />
        <LessonNumber
          label="effective draws"
          metric="sides.a.essBulkMin"
          value={sides?.a.essBulkMin}
          show={(value) => number(value, 3)}
          note={
            <span data-metric="sides.b.essBulkMin" data-value={sides?.b.essBulkMin ?? undefined}>
              {sides?.b.essBulkMin == null ? "–" : number(sides.b.essBulkMin, 3)} of B
            </span>
          }
        />
      </LessonNumbers>
      {found && (
        <AdviceLine
          advice={{
            ...cloudVerdict(
              run.draws.value,
              found.grassmann,
              found.closedForm,
              predicted,
              worst(sides?.a.rHatMax, sides?.b.rHatMax),
            ),
            chain: null,
          }}
        />
      )}
    </>
  );
}

function worst(...found: readonly (number | null | undefined)[]): number | null {
  const known = found.filter((value): value is number => value != null);
  return known.length === 0 ? null : Math.max(...known);
}

function Questions() {
  return (
    <div class="scene-questions">
      <details>
        <summary>Which sampler needs the fewest draws? Change it and compare the dots</summary>
        <p>
          The independence sampler: its draws are nearly independent, so d<sub>G</sub> follows the
          dashed line from the start. Draws of the walks hang together; as many of them are worth
          far fewer.
        </p>
      </details>
      <details>
        <summary>How can a closed form beat any number of draws?</summary>
        <p>
          For stars the posterior is a Gaussian, as only one point is away from the other model. Its
          mean and covariance follow from linear algebra, with no noise at all. What is left of d_G
          is what σ lets through.
        </p>
      </details>
      <details>
        <summary>Why is the model of the draws narrower than the truth?</summary>
        <p>
          A draw must be plausible in A <em>and</em> in B: the paper multiplies both plausibilities.
          Even the intersection of a model with itself would come out with half its variance. d
          <sub>G</sub> does not mind: it compares directions, not lengths.
        </p>
      </details>
    </div>
  );
}
