import { pairings, pairsSentence } from "../../stage/pairs";
import { pairRank } from "../../state/state";
import { FIRST_VIEW } from "../../state/view";
import { count } from "../../text/format";
import { Slider } from "../../ui/Slider";

/** What the view Pairs shows, and a slider from the shapes nearest to the other model to those furthest from it. */
export function PairsBar() {
  const shown = pairings.value;
  const rank = pairRank.value;
  const places = shown ? `${count(shown.a.rank)} and ${count(shown.b.rank)}` : "–";
  const words = rank === 0 ? "nearest" : rank === 100 ? "furthest" : `place ${places}`;
  return (
    <div class="pairs-bar">
      <p class="small contrast-caption">{pairsSentence.value}</p>
      <Slider
        label="Nearest to furthest"
        name="Which shapes, from the nearest to the furthest"
        value={rank}
        least={0}
        most={100}
        step={1}
        words={words}
        shown={
          shown ? `place ${places} of ${count(shown.a.count)} and ${count(shown.b.count)}` : ""
        }
        onMove={(place) => {
          pairRank.value = place;
        }}
        onReset={() => {
          pairRank.value = FIRST_VIEW.rank;
        }}
      />
    </div>
  );
}
