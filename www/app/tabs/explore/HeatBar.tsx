/** Colour scale of the explored shapes: residual per vertex, one scale for all panes. */

import { choose, explorer, lockedHeat } from "../../state/exploring";
import { unit } from "../../state/state";
import { viridisGradient } from "../../text/colormap";
import { number } from "../../text/format";
import { Check } from "../../ui/Check";
import { heatRange, ownHeat } from "./controller";
import { followers, SIGNS } from "./words";

export function HeatBar() {
  const { heat, space } = explorer.value;
  const range = heatRange.value;
  const who = followers(space)
    .map((side) => SIGNS[side])
    .join(" or ");
  return (
    <div class="heat-bar">
      <Check checked={heat} onChange={(checked) => choose({ heat: checked })}>
        Colour what {who} misses
      </Check>
      {range && <Scale range={range} who={who} />}
    </div>
  );
}

function Scale({ range, who }: { range: [number, number]; who: string }) {
  const locked = lockedHeat.value !== null;
  const beyond = locked && (ownHeat.value ?? 0) > range[1];
  const note = locked ? (beyond ? " (locked; some values lie beyond)" : " (locked)") : "";
  return (
    <>
      <figure class="color-bar" aria-label={`Colours: what ${who} misses per vertex${note}`}>
        <span class="num">0</span>
        <span class="ramp" style={{ background: viridisGradient() }} />
        <span class="num" data-explore="heat-end" data-value={range[1]}>
          {number(range[1])} {unit.value} per vertex
        </span>
      </figure>
      <Check
        checked={locked}
        onChange={(checked) => {
          lockedHeat.value = checked ? ownHeat.value : null;
        }}
      >
        Lock scale{beyond && <span class="small">; some values lie beyond</span>}
      </Check>
    </>
  );
}
