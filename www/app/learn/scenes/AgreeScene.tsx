import { useSignal } from "@preact/signals";
import { number } from "../../format";
import { useAsk, useAsked, useDone } from "../asked";
import { still, useFrames } from "../clock";
import { useSceneKeys } from "../keys";
import { PlayBar, Slider } from "../parts/controls";
import { STAR_PAIRS } from "../scenes";
import { params, resetScene, setParams } from "../state";
import { GuessBoard } from "./agree/GuessBoard";
import { MovingStar } from "./agree/MovingStar";
import { TELLING } from "./agree/sweep";
import { TipTable } from "./agree/TipTable";
import { answerIn, movable, named, verdictOn } from "./agree/tips";
import "../../../styles/learn-agree.css";

/** Two models side by side: which tips can both move? Guess, then see. */
export function AgreeScene() {
  const { pair, sigma, guess, shown } = params("agree").value;
  const ask = useAsk();
  const lesson = useAsked(ask, { ask: "open", pair, sigma });
  const seconds = useSignal(TELLING);
  const playing = useSignal(!still.peek());
  useFrames(playing, (elapsed) => {
    seconds.value += elapsed / 1000;
  });
  useDone(lesson.current);
  const toggle = () => {
    playing.value = !playing.peek();
  };
  useSceneKeys(toggle, null);
  const models = lesson.answer;
  const choose = (tip: number) =>
    setParams("agree", {
      guess: guess.includes(tip)
        ? guess.filter((other) => other !== tip)
        : [...guess, tip].sort((first, second) => first - second),
    });
  const tips = models && {
    a: movable(models.a.vertexSd),
    b: movable(models.b.vertexSd),
    both: movable(models.intersection.vertexSd),
  };
  const star = (whose: "a" | "b", label: string) => (
    <MovingStar
      model={models?.[whose] ?? null}
      whose={whose}
      seconds={seconds.value}
      label={label}
    />
  );
  return (
    <>
      <p class="lead">
        Model A was learnt from stars of one kind, model B from stars of another. Watch what each
        can do. <strong>Which tips can both of them move?</strong>
      </p>
      <div class="agree-boards">
        <figure class="agree-a">
          {star("a", "Model A: a star that moves two of its tips.")}
          <figcaption>
            <b>A</b> <span class="board-caption">what A can make</span>
          </figcaption>
        </figure>
        <figure class="agree-b">
          {star("b", "Model B: a star that moves two of its tips.")}
          <figcaption>
            <b>B</b> <span class="board-caption">what B can make</span>
          </figcaption>
        </figure>
        <figure class="agree-ab">
          {shown ? (
            <MovingStar
              model={models?.intersection ?? null}
              whose="ab"
              seconds={seconds.value}
              label="A and B in common: a star that moves as far as both can."
            />
          ) : (
            <GuessBoard guess={guess} onToggle={choose} />
          )}
          <figcaption>
            <b>A∩B</b>{" "}
            <span class="board-caption">
              {shown ? "what both can make" : "your guess: click the tips"}
            </span>
          </figcaption>
        </figure>
      </div>
      <div class="agree-bar">
        {shown ? (
          <button type="button" onClick={() => setParams("agree", { shown: false, guess: [] })}>
            Guess again
          </button>
        ) : (
          <button type="button" class="primary" onClick={() => setParams("agree", { shown: true })}>
            Reveal
          </button>
        )}
        <span class="agree-guess" aria-live="polite">
          {!shown && (guess.length > 0 ? `You say: ${named(guess)}.` : "You have not guessed yet.")}
        </span>
        <PlayBar playing={playing.value} onToggle={toggle} onReset={resetScene} />
      </div>
      {shown && tips && models && (
        <div class="agree-answer">
          <p class="agree-verdict" role="status" data-verdict={verdictOn(guess, tips.both)}>
            {answerIn(guess, tips)}
          </p>
          <TipTable models={models} both={tips.both} guess={guess} />
          <div class="agree-sigma">
            <Slider
              label="σ, how near is near"
              value={sigma}
              least={0.001}
              most={1}
              step={0}
              logarithmic
              show={(value) => number(value, 2)}
              onChange={(value) => setParams("agree", { sigma: Number(value.toPrecision(2)) })}
            />
            <p>
              The two means, dashed, differ as well; hardly any star is made by both to the last
              digit. So <em>both can make it</em> asks two things of a star: that it is <b>near</b>{" "}
              some star of the other model (the mean distance of its points within about σ), and
              that it is <b>plausible</b> in both. Move σ: what happens when almost everything is
              near?
            </p>
          </div>
        </div>
      )}
      {shown && (
        <details class="ask">
          <summary>
            A∩B moves the top tip less than A does, and less than B. Why, if both can do it?
          </summary>
          <p>
            Because what is plausible in both is rarer than what is plausible in one. The method
            multiplies the two plausibilities, exp(−½‖α‖²) and exp(−½‖α′‖²), and the product of two
            bells is a narrower bell, between the two. Even a model intersected with itself keeps
            only half of its variance.
          </p>
        </details>
      )}
      <p class="board-caption agree-pair">
        <label>
          The paper has six such pairs; here is{" "}
          <select
            value={pair}
            onChange={({ currentTarget }) => {
              const chosen = STAR_PAIRS.find((name) => name === currentTarget.value);
              if (chosen) setParams("agree", { pair: chosen });
            }}
          >
            {STAR_PAIRS.map((name) => (
              <option key={name} value={name}>
                pair {name.slice(-1)}
              </option>
            ))}
          </select>
        </label>{" "}
        Each star sweeps its modes one after the other, from −2 to +2 standard deviations.
      </p>
    </>
  );
}
