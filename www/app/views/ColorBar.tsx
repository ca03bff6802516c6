import { gradientOf } from "../colormap";
import { number, signed } from "../format";
import { MAP_WORDS, mapCaption, scaleEnds } from "../map-words";
import { mapProblem, mapRange, ownRange, shownMap } from "../maps";
import { lockedRange, unit } from "../state";

/** One scale for all panes, and what is coloured in words. */
export function ColorBar() {
  const range = mapRange.value;
  const map = shownMap.value;
  if (mapProblem.value) return <p class="small">{mapProblem.value}</p>;
  if (!range) return <p class="small">{MAP_WORDS[map.name].label}: waiting for the engine.</p>;
  const [low, high] = range;
  const own = ownRange.value;
  const beyond = own !== null && (own[0] < low || own[1] > high);
  const ends = scaleEnds(map.name, map.signed);
  // What is only rounding error beside the other end is none.
  const text = (value: number) => {
    const shown = Math.abs(value) < 1e-9 * high ? 0 : value;
    return map.signed ? signed(shown) : number(shown);
  };
  return (
    <figure class="color-bar" data-low={low} data-high={high}>
      <figcaption title={MAP_WORDS[map.name].help}>
        {mapCaption(map.name, map, unit.value)}
        {lockedRange.value ? (beyond ? " (locked; some values lie beyond)" : " (locked)") : ""}
      </figcaption>
      <span class="scale">
        {ends && <span class="scale-end">{ends[0]}</span>}
        <span class="num">{text(low)}</span>
        <span class="ramp" style={{ background: gradientOf(map.palette) }}>
          {map.signed && <span class="zero">0</span>}
        </span>
        <span class="num">{text(high)}</span>
        {ends && <span class="scale-end">{ends[1]}</span>}
      </span>
    </figure>
  );
}
