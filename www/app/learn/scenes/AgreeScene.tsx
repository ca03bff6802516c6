import { useSignal } from "@preact/signals";
import { useAsk, useAsked, useDone } from "../asked";
import { still, useFrames } from "../clock";
import { useSceneKeys } from "../keys";
import { PlayBar } from "../parts/controls";
import { StarPairs } from "../parts/StarPairs";
import { params, resetScene, setParams } from "../state";
import { Answer } from "./agree/Answer";
import { GuessCanvas } from "./agree/GuessCanvas";
import { MovingStar } from "./agree/MovingStar";
import { TELLING } from "./agree/sweep";
import { named } from "./agree/tips";
import "./agree.css";

/** Scene with two models side by side: the visitor guesses which tips both can move, then sees the answer. */
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
        Model A was computed from stars of one kind, model B from stars of another. Watch how the
        shapes of each vary. <strong>Which tips can both of them move?</strong>
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
              label="A∩B: a star that moves only as both models can."
            />
          ) : (
            <GuessCanvas guess={guess} onToggle={choose} />
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
      {shown && models && <Answer models={models} guess={guess} sigma={sigma} />}
      <p class="board-caption agree-pair">
        <StarPairs
          label="The paper has six such pairs. Shown:"
          value={pair}
          onChoose={(chosen) => setParams("agree", { pair: chosen })}
        />{" "}
        Each star shows its modes one after the other, from −2 to +2 standard deviations.
      </p>
    </>
  );
}
