import { number } from "../format";
import type { Side } from "../state";

const [WIDTH, HEIGHT] = [120, 44];

/** Standard deviations of the modes, largest first, as bars. */
export function Scree({ deviations, side }: { deviations: number[]; side: Side }) {
  const largest = Math.max(...deviations, 1e-300);
  const shown = deviations.slice(0, 60);
  const step = WIDTH / Math.max(shown.length, 8);
  const [first = 0, last = 0] = [deviations[0], deviations.at(-1)];
  return (
    <svg
      class="scree-plot"
      data-side={side}
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      preserveAspectRatio="none"
      role="img"
      aria-label={`Standard deviations of ${deviations.length} modes, from ${number(first)} down to ${number(last)}`}
    >
      {shown.map((deviation, i) => {
        const height = Math.max(0.75, (deviation / largest) * HEIGHT);
        return (
          <rect key={i} x={i * step} y={HEIGHT - height} width={step * 0.72} height={height} />
        );
      })}
    </svg>
  );
}
