import { viridisGradient } from "../colormap";
import { number } from "../format";
import { lockedRange, unit } from "../state";

interface Props {
  range: readonly [number, number] | null;
  own: readonly [number, number] | null;
}

/** One scale for all panes. */
export function ColorBar({ range, own }: Props) {
  if (!range) return null;
  const [low, high] = range;
  const beyond = own !== null && (own[0] < low || own[1] > high);
  return (
    <figure class="color-bar">
      <figcaption>
        Standard deviation per vertex, {unit.value}
        {lockedRange.value ? (beyond ? " (locked; some values lie beyond)" : " (locked)") : ""}
      </figcaption>
      {/* What is only rounding error beside the other end is none. */}
      <span class="num">{number(Math.abs(low) < 1e-9 * high ? 0 : low)}</span>
      <span class="ramp" style={{ background: viridisGradient() }} />
      <span class="num">{number(high)}</span>
    </figure>
  );
}
