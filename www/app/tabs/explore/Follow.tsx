/** Shows whether the other model can make the explored shape: in words, in numbers, and on a meter. */
import type { Nearest, Sides } from "../../../worker/protocol";
import { answer, sigmaInUse } from "../../state/exploring";
import { outOfDate, unit } from "../../state/state";
import { length, number, percent } from "../../text/format";
import {
  followers,
  followQuestion,
  followWords,
  meterValue,
  meterWords,
  rarity,
  SIGNS,
  unusual,
  whoCanMake,
} from "./words";

/** The result for the explored shape. Its height is constant, so that the shapes do not move while sliders do. */
export function Follow() {
  const found = answer.value;
  const nearest = found?.explored.nearest;
  if (!found || !nearest) return null;
  const { space } = found;
  const { norm, plausibility } = found.explored;
  return (
    <section class="follow" aria-label="Can the other model make it?" data-stale={outOfDate.value}>
      <div class="follow-words" data-followers={followers(space).length}>
        <h3>{followQuestion(space)}</h3>
        {followers(space).map((side) => (
          <p key={side} data-follows={side}>
            {followWords(SIGNS[side], nearest[side], sigmaInUse.value)}
          </p>
        ))}
      </div>
      {nearest.a.likelihood !== null && nearest.b.likelihood !== null && (
        <Meter ofA={nearest.a.likelihood} ofB={nearest.b.likelihood} />
      )}
      <NearestTable sides={followers(space)} nearest={nearest} />
      <p class="small">
        The shape itself is <Value name="norm" value={norm} text={number(norm)} /> SD from the mean
        of {SIGNS[space]},{" "}
        <Value
          name="plausibility"
          value={plausibility}
          text={unusual(plausibility, SIGNS[space])}
        />
        .
      </p>
    </section>
  );
}

function Value({ name, value, text }: { name: string; value: number; text: string }) {
  return (
    <span class="metric" data-explore={name} data-value={value}>
      {text}
    </span>
  );
}

interface NearestProps {
  sides: ("a" | "b")[];
  nearest: Sides<Nearest>;
}

/** Distance, likelihood and plausibility of the nearest shape of each other model. */
function NearestTable({ sides, nearest }: NearestProps) {
  const sigma = sigmaInUse.value;
  return (
    <table class="numbers">
      <thead>
        <tr>
          <th scope="col">Nearest shape</th>
          <th scope="col">mean distance d</th>
          <th scope="col">
            likelihood L<sub>D</sub>
          </th>
          <th scope="col">among its model’s shapes</th>
        </tr>
      </thead>
      <tbody>
        {sides.map((side) => {
          const { distance, likelihood, plausibility } = nearest[side];
          return (
            <tr key={side}>
              <th scope="row">of {SIGNS[side]}</th>
              <td>
                <Value name="distance" value={distance} text={length(distance, unit.value)} />
                {sigma !== null && (
                  <span class="dim follow-sigma"> (σ {length(sigma, unit.value)})</span>
                )}
              </td>
              <td>
                {likelihood !== null && (
                  <Value name="likelihood" value={likelihood} text={percent(likelihood)} />
                )}
              </td>
              <td>
                <Value name="followed" value={plausibility} text={rarity(plausibility)} />
              </td>
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

/** Meter from “A only” on the left to “B only” on the right, by the likelihoods L_D of both models. */
function Meter({ ofA, ofB }: { ofA: number; ofB: number }) {
  const value = meterValue(ofA, ofB);
  const words = meterWords(ofA, ofB);
  return (
    <div class="place">
      <p class="meter-words" aria-live="polite">
        {words}
      </p>
      {/* biome-ignore lint/a11y/useSemanticElements: it goes both ways from its middle, and has words */}
      <div
        class="meter"
        role="meter"
        aria-label="Where the shape lies"
        aria-valuemin={-1}
        aria-valuemax={1}
        aria-valuenow={Number(value.toFixed(3))}
        aria-valuetext={words}
        data-neither={whoCanMake(ofA, ofB) === "neither"}
      >
        <i style={{ left: `${50 + 50 * value}%` }} />
      </div>
      <p class="meter-ends" aria-hidden="true">
        <span>A only</span>
        <span>both</span>
        <span>B only</span>
      </p>
    </div>
  );
}
