/** Whether the other model can follow, in words, in numbers, and on a meter. */
import type { Nearest } from "../../../worker/protocol";
import { answer, explorer, sigmaInUse } from "../../explore/state";
import { followWords, meterValue, meterWords, otherOf, SIGNS, unusual } from "../../explore/words";
import { length, number, percent } from "../../format";
import { unit } from "../../state";

export function Follow() {
  const found = answer.value;
  const placed = found?.explored.placed;
  if (!found || !placed) return null;
  const { space } = explorer.value;
  if (found.space !== space) return null;
  const { norm, plausibility } = found.explored;
  return (
    <section class="follow" aria-label="Can the other model follow?">
      <Meter ofA={placed.a.likelihood} ofB={placed.b.likelihood} />
      <p>
        <span class="dim">{SIGNS[space]}:</span>{" "}
        <Figure name="norm" value={norm} text={number(norm, 3)} /> SD from the mean,{" "}
        <Figure
          name="plausibility"
          value={plausibility}
          text={unusual(plausibility, SIGNS[space])}
        />
        .
      </p>
      {space === "intersection" ? (
        <>
          <Reach side="a" nearest={placed.a} />
          <Reach side="b" nearest={placed.b} />
        </>
      ) : (
        <Reach side={otherOf(space)} nearest={placed[otherOf(space)]} />
      )}
    </section>
  );
}

function Figure({ name, value, text }: { name: string; value: number; text: string }) {
  return (
    <span class="metric" data-explore={name} data-value={value}>
      {text}
    </span>
  );
}

function Reach({ side, nearest }: { side: "a" | "b"; nearest: Nearest }) {
  const sigma = sigmaInUse.value;
  const { distance, likelihood, plausibility } = nearest;
  return (
    <p data-follows={side}>
      <strong>{followWords(SIGNS[side], distance, sigma)}</strong> Its nearest shape is{" "}
      <Figure name="distance" value={distance} text={length(distance, unit.value)} /> away on
      average
      {sigma !== null && <> (σ is {length(sigma, unit.value)})</>}, so the likelihood L<sub>D</sub>{" "}
      is <Figure name="likelihood" value={likelihood} text={percent(likelihood)} />; that shape is{" "}
      <Figure name="followed" value={plausibility} text={unusual(plausibility, SIGNS[side])} />.
    </p>
  );
}

/** From A only on the left to B only on the right. */
function Meter({ ofA, ofB }: { ofA: number; ofB: number }) {
  const value = meterValue(ofA, ofB);
  const words = meterWords(ofA, ofB);
  const neither = Math.max(ofA, ofB) < Math.exp(-2);
  return (
    <div class="place">
      {/* biome-ignore lint/a11y/useSemanticElements: it goes both ways from its middle, and has words */}
      <div
        class="meter"
        role="meter"
        aria-label="Where the shape lies"
        aria-valuemin={-1}
        aria-valuemax={1}
        aria-valuenow={Number(value.toFixed(3))}
        aria-valuetext={words}
        data-neither={neither}
      >
        <span>A only</span>
        <span>both</span>
        <span>B only</span>
        <i style={{ left: `${50 + 50 * value}%` }} />
      </div>
      <p class="meter-words" aria-live="polite">
        {words}
      </p>
    </div>
  );
}
