import { lockedRange, unit, view } from "../state/state";
import { gradientOf } from "../text/colormap";
import { number, percent, signed, withoutRoundingError } from "../text/format";
import { Check } from "../ui/Check";
import { Slider } from "../ui/Slider";
import { contrastSentence } from "./contrast";
import { MAP_WORDS, mapCaption, scaleEnds } from "./map-words";
import { LEVEL, mapProblem, mapRange, ownRange, shownMap } from "./maps";

/** The level up to which p-values are coloured, and the share of the points that differ at it. */
function Level({ level, values }: { level: number; values: Float32Array | undefined }) {
  const differ = values?.filter((p) => p <= level).length ?? 0;
  const share = values && values.length > 0 ? percent(differ / values.length) : "–";
  const set = (value: number) => {
    lockedRange.value = value === LEVEL ? null : [0, value];
  };
  return (
    <>
      <Slider
        label="Level"
        name="Level of the family-wise p-values"
        value={level}
        least={0.005}
        most={0.2}
        step={0.005}
        words={number(level, 2)}
        shown={number(level, 2)}
        onMove={set}
        onReset={() => set(LEVEL)}
      />
      <span class="small">The means differ at {share} of the points.</span>
    </>
  );
}

/** Colour bar of the map: one scale for all panes, with a caption. */
export function ColorBar() {
  const range = mapRange.value;
  const map = shownMap.value;
  if (mapProblem.value) return <p class="small">{mapProblem.value}</p>;
  if (!range && view.value === "contrast" && contrastSentence.value !== "") return null;
  if (!range) return <p class="small">{MAP_WORDS[map.name].label}: waiting for the engine.</p>;
  const [low, high] = range;
  const own = ownRange.value;
  // A locked range has as many digits as links have.
  const slack = 1e-5 * (high - low);
  const beyond = own !== null && (own[0] < low - slack || own[1] > high + slack);
  const ends = scaleEnds(map.name, map.signed);
  const text = (value: number) => (map.signed ? signed : number)(withoutRoundingError(value, high));
  return (
    <figure class="color-bar" data-low={low} data-high={high}>
      <figcaption title={MAP_WORDS[map.name].help}>
        {mapCaption(map.name, map, unit.value)}
        {lockedRange.value && map.name !== "chance"
          ? beyond
            ? " (locked; some values lie beyond)"
            : " (locked)"
          : ""}
      </figcaption>
      <span class="scale">
        {ends && <span class="scale-end">{ends[0]}</span>}
        <span class="num">{text(low)}</span>
        <span class="ramp" style={{ background: gradientOf(map.palette) }}>
          {map.signed && <span class="zero">0</span>}
        </span>
        <span class="num">
          {map.covers === undefined ? "" : "≥\u202f"}
          {text(high)}
        </span>
        {ends && <span class="scale-end">{ends[1]}</span>}
      </span>
      {map.name === "chance" ? (
        <Level level={high} values={map.values.a} />
      ) : (
        <Check
          checked={lockedRange.value !== null}
          onChange={(checked) => {
            lockedRange.value = checked ? mapRange.value : null;
          }}
        >
          Lock scale
        </Check>
      )}
    </figure>
  );
}
