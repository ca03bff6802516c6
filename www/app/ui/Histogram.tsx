import type { Chance } from "../../worker/protocol";
import { linear, ticks } from "../text/plots";
import { Mark } from "./Mark";
import { PlotAxes } from "./PlotAxes";

/** Narrowest bar in pixels: all values may be the same. */
const LEAST_WIDTH = 4;

interface Props {
  width: number;
  height: number;
  chance: Chance;
  observed: number;
  acrossName: string;
  show: (value: number) => string;
}

/** Plot of a number under relabelling: bars of its values, the band of 5 to 95 %, and the observed value. */
export function Histogram({ width, height, chance, observed, acrossName, show }: Props) {
  const { from, to, counts } = chance.histogram;
  // Room for half a tick label on either side.
  const box = { left: 20, right: width - 20, top: 22, bottom: height - 34 };
  const [least, most] = [Math.min(from, observed), Math.max(to, observed)];
  const x = linear(least, most, box.left, box.right);
  const y = linear(0, Math.max(...counts, 1), box.bottom, box.top + 2);
  const step = (to - from) / counts.length;
  const at = x(observed);
  const end = at > (box.left + box.right) / 2;
  const across = ticks(least, most, Math.max(3, Math.floor(width / 80))).filter(
    (value) => value >= least && value <= most,
  );
  return (
    <>
      <rect
        class="band"
        x={x(chance.p05)}
        width={Math.max(LEAST_WIDTH, x(chance.p95) - x(chance.p05))}
        y={box.top}
        height={box.bottom - box.top}
      />
      <g class="chance-bars">
        {counts.map((count, i) => (
          <rect
            key={i}
            x={x(from + i * step)}
            width={Math.max(LEAST_WIDTH, x(from + step) - x(from)) - 1}
            y={y(count)}
            height={box.bottom - y(count)}
          />
        ))}
      </g>
      <PlotAxes
        box={box}
        x={x}
        y={y}
        across={across.length > 0 ? across : [least]}
        up={[0]}
        acrossName={acrossName}
        upName=""
        showAcross={show}
        showUp={() => ""}
      />
      <g class="observed">
        <line x1={at} x2={at} y1={box.top} y2={box.bottom} />
        <Mark kind="diamond" x={at} y={box.top} />
        <text
          class="tick"
          x={end ? at - 6 : at + 6}
          y={box.top - 6}
          text-anchor={end ? "end" : "start"}
        >
          observed
        </text>
      </g>
    </>
  );
}
