import type { Side } from "../../worker/protocol";
import { number } from "../text/format";

const [WIDTH, HEIGHT] = [120, 44];
/** Half length of the error bars, in standard errors. */
const ERRORS_SHOWN = 2;

interface Props {
  deviations: number[];
  side: Side | "ab";
  /** Standard error of each deviation. */
  errors?: number[] | undefined;
  /** Modes, from 1, that are not determined one by one. */
  doubtful?: Set<number> | undefined;
  /** Number of compared modes, if not all. */
  kept?: number | undefined;
}

/** Scree plot: standard deviations of the modes as bars, largest first. */
export function Scree({ deviations, side, errors, doubtful, kept }: Props) {
  const ends = deviations.map((deviation, i) => deviation + ERRORS_SHOWN * (errors?.[i] ?? 0));
  const largest = Math.max(...ends, 1e-300);
  const shown = deviations.slice(0, 60);
  const step = WIDTH / Math.max(shown.length, 8);
  const [first = 0, last = 0] = [deviations[0], deviations.at(-1)];
  const tall = (value: number) => (Math.max(0, value) / largest) * HEIGHT;
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
        const height = Math.max(0.75, tall(deviation));
        const error = ERRORS_SHOWN * (errors?.[i] ?? 0);
        const middle = (i + 0.36) * step;
        return (
          <g
            key={i}
            data-doubtful={doubtful?.has(i + 1)}
            data-left-out={kept !== undefined && i >= kept}
          >
            <rect x={i * step} y={HEIGHT - height} width={step * 0.72} height={height} />
            {error > 0 && (
              <line
                class="error"
                x1={middle}
                x2={middle}
                y1={HEIGHT - tall(deviation - error)}
                y2={HEIGHT - tall(deviation + error)}
              />
            )}
          </g>
        );
      })}
    </svg>
  );
}
