import { useEffect, useMemo, useRef } from "preact/hooks";
import { count, number, percent, plusMinus } from "../../format";
import { AdviceLine } from "../../views/Chart";
import { Segments } from "../../views/Segments";
import { Board } from "../canvas/Board";
import { useFrames } from "../clock";
import { useSceneKeys } from "../keys";
import { LessonNumber, LessonNumbers, PlayBar, Slider } from "../parts/controls";
import { PairChoice, SeedField, SideChoice, SigmaSlider } from "../sampling/Controls";
import { useSession } from "../sampling/session";
import { differenceVerdict } from "../sampling/verdicts";
import { PAIRS } from "../scenes";
import { params, resetScene, setParams } from "../state";
import { drawCut, drawDifference, Morph } from "./difference/draw";
import { DifferenceRun, type DifferenceValues } from "./difference/run";
import { ShareChart } from "./difference/ShareChart";
import "../../../styles/learn-samplers.css";

const USUAL_SIGMA = { planes: 0.3, stars: 0.03 };

/** The likelihood upside down: what one model can make and the other cannot. */
export function DifferenceScene() {
  const run = useMemo(() => new DifferenceRun(), []);
  const values = params("difference").value;
  const { pair, sigma, side, seed, draws, flipped } = values;
  const isFirst = useRef(true);
  const mine = useRef(flipped);
  useSession([pair, sigma, side, seed, draws].join(), async (ask) => {
    // The story is told to those who come, not to those who set something, nor where a link says what is up.
    const told = isFirst.current && !flipped;
    if (isFirst.current) run.place(flipped);
    isFirst.current = false;
    await run.open(ask, params("difference").peek(), told);
  });
  useEffect(() => {
    if (mine.current !== flipped) run.place(flipped);
    mine.current = flipped;
  }, [flipped]);
  useFrames(run.moving, (elapsed) => run.frame(elapsed));
  const change = (part: Partial<DifferenceValues>) => setParams("difference", part);
  const turn = (to: boolean) => {
    mine.current = to;
    run.turn(to);
    change({ flipped: to });
  };
  const toggle = () => run.toggleRain();
  useSceneKeys(toggle, () => turn(!run.flipped.peek()));
  const [own, other] = side === "a" ? (["A", "B"] as const) : (["B", "A"] as const);
  return (
    <>
      <p class="lead">
        What can {own} make that {other} <em>cannot</em>? Turn the likelihood upside down: where Lᴅ
        was near one, 1 − Lᴅ is near nought. The ridge becomes a hole.
      </p>
      <div class="scene-bar">
        <Segments
          legend="Likelihood"
          name="difference-flip"
          value={run.flipped.value ? "flipped" : "plain"}
          options={[
            ["plain", `Lᴅ: ${other} can too`],
            ["flipped", `1 − Lᴅ: ${other} cannot`],
          ]}
          onChoose={(option) => turn(option === "flipped")}
        />
        <PlayBar playing={run.raining.value} onToggle={toggle} onReset={resetScene} />
        <SigmaSlider
          value={sigma}
          least={0.003}
          most={3}
          onChange={(next) => change({ sigma: next })}
        />
      </div>
      <div class="scene-body">
        <Plane run={run} side={side} />
        <div class="scene-side">
          <Cut run={run} />
          <Figures run={run} own={own} other={other} side={side} />
          <ShareChart shares={run.shares.value} sigma={sigma} own={own} other={other} />
        </div>
      </div>
      <div class="scene-settings">
        <Slider
          label="Draws"
          least={16}
          most={5000}
          step={0}
          logarithmic
          value={draws}
          show={count}
          onChange={(next) => change({ draws: Math.round(next) })}
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

/** Alone, as it is drawn every frame. */
function Plane({ run, side }: { run: DifferenceRun; side: "a" | "b" }) {
  const morph = useMemo(() => new Morph(), []);
  const found = run.found.value;
  const flip = run.flip.value;
  run.rain.value;
  const what = flip > 0.5 ? "difference" : "intersection";
  return (
    <figure>
      <Board
        label={`Density of the ${what} over two coefficients, with its draws and the ellipse of two standard deviations of their PCA`}
        aspect={1}
        draw={(pen, size, palette) => {
          if (!found) return;
          const fallen = (draws: number) => run.fallen(draws);
          drawDifference(pen, size, palette, { found, morph, flip, side, fallen });
        }}
      />
      <figcaption class="board-caption">
        Bright: much of the {what}. Dots: exact draws, by rejection. The dashed ellipse is what a
        mean and a covariance make of them.
      </figcaption>
    </figure>
  );
}

function Cut({ run }: { run: DifferenceRun }) {
  const found = run.found.value;
  const flip = run.flip.value;
  return (
    <figure>
      <Board
        label={`${flip > 0.5 ? "1 − Lᴅ" : "Lᴅ"} along the second coefficient where the first is 0`}
        aspect={0.36}
        draw={(pen, size, palette) => found && drawCut(pen, size, palette, found.likelihood, flip)}
      />
      <figcaption class="board-caption">
        A cut along α₂ at α₁ = 0: {flip > 0.5 ? "1 − Lᴅ" : "Lᴅ"}.
      </figcaption>
    </figure>
  );
}

interface FiguresProps {
  run: DifferenceRun;
  own: string;
  other: string;
  side: "a" | "b";
}

function Figures({ run, own, other, side }: FiguresProps) {
  const found = run.found.value;
  const { probability = null, standardError = null } = found?.figures ?? {};
  const { misled, misledDraws } = found?.principal ?? {};
  return (
    <>
      <p class="lesson-headline">
        <strong data-metric="figures.probability" data-value={probability ?? undefined}>
          {probability === null ? "–" : percent(probability)}
        </strong>{" "}
        <span
          class="dim"
          data-metric="figures.standardError"
          data-value={standardError ?? undefined}
        >
          ± {standardError === null ? "–" : plusMinus(0, 100 * standardError).spread}
        </span>{" "}
        of {own} cannot be made by {other}: E[1 − Lᴅ].
      </p>
      <LessonNumbers label="What principal components would claim">
        <LessonNumber
          label={`PCA’s shapes that ${other} makes too`}
          metric="principal.misled"
          value={misled}
          show={percent}
        />
        <LessonNumber
          label="the same of the draws"
          metric="principal.misledDraws"
          value={misledDraws}
          show={percent}
        />
      </LessonNumbers>
      {found && misled !== undefined && probability !== null && (
        <AdviceLine advice={{ ...differenceVerdict(side, probability, misled), chain: null }} />
      )}
      {found && (
        <p class="small">Recommended σ of this pair: {number(found.models.recommended)}.</p>
      )}
    </>
  );
}

function Questions() {
  return (
    <div class="scene-questions">
      <details>
        <summary>Make σ smaller and smaller. What becomes of the difference?</summary>
        <p>
          The ridge gets thinner: fewer and fewer shapes lie within σ of the other model, until the
          hole is a scratch and the difference is all of the model. σ says how far apart two shapes
          may be and still count as the same.
        </p>
      </details>
      <details>
        <summary>Why no principal components of a difference?</summary>
        <p>
          A Gaussian is highest in the middle, and the middle is the hole. Its mean shape is one
          that both models make. So the paper gives draws of the difference, and no model.
        </p>
      </details>
      <details>
        <summary>Why are these draws independent, unlike those of a chain?</summary>
        <p>
          1 − Lᴅ lies between nought and one. Draw a shape of the model and keep it with that
          probability: what is kept follows the difference exactly. The share that is kept is the
          headline above.
        </p>
      </details>
    </div>
  );
}
