import { linear, type Scale, ticks } from "../text/plots";
import { Chart, type ChartProps } from "./Chart";
import { Mark } from "./Mark";
import { PlotAxes, wholeTicks } from "./PlotAxes";

export interface Curve {
  key: string;
  label: string;
  mark: "circle" | "square" | "diamond";
  /** Values at 1, 2, …, or at `at`. */
  values: readonly number[];
  at?: readonly number[];
  /** Half lengths of the error bars. */
  errors?: readonly number[];
  /** Whether the marks are joined. */
  line?: boolean;
}

/** What chance gives of a curve: its mean and the band in which most of it lies. */
export interface ChanceBand {
  label: string;
  mean: readonly number[];
  low?: readonly number[];
  high?: readonly number[];
}

/** A vertical line at a number of modes. */
export interface Level {
  at: number;
  label: string;
}

interface Props {
  width: number;
  height: number;
  curves: readonly Curve[];
  /** Drawn behind the curves. */
  chance?: ChanceBand;
  level?: Level;
  acrossName: string;
  upName: string;
  /** Upper end of the plot, if fixed. */
  top?: number;
  up?: readonly number[];
  showUp?: (value: number) => string;
}

interface CurveChartProps extends Omit<ChartProps, "height" | "draw" | "legend"> {
  plot: Omit<Props, "width">;
}

/** Chart of curves over the number of modes, with a legend if there is more than one. */
export function CurveChart({ plot, ...chart }: CurveChartProps) {
  return (
    <Chart
      {...chart}
      height={() => plot.height}
      draw={(width) => <Curves width={width} {...plot} />}
      legend={
        (plot.curves.length > 1 || plot.chance) && (
          <CurveLegend curves={plot.curves} chance={plot.chance} />
        )
      }
    />
  );
}

/** Largest number of points that have marks; longer curves are lines only. */
const MOST_MARKS = 60;

/** Plot of curves over the number of modes, from 0 upwards. They differ in marks and dashes, not only in colour. */
function Curves({ width, height, curves, acrossName, upName, top, showUp, ...props }: Props) {
  const box = { left: 46, right: width - 10, top: 24, bottom: height - 36 };
  const { chance, level } = props;
  const ends = curves
    .flatMap(({ values, errors }) => values.map((value, i) => value + (errors?.[i] ?? 0)))
    .concat(chance?.mean ?? [], chance?.high ?? []);
  const highest = top ?? Math.max(...ends, 0);
  const up = props.up ?? ticks(0, highest, 4).filter((value) => top === undefined || value <= top);
  const last = Math.max(2, ...curves.flatMap(({ values, at }) => at ?? [values.length]));
  const x = linear(1, last, box.left + 8, box.right - 4);
  const y = linear(0, Math.max(highest, up.at(-1) ?? 0), box.bottom, box.top);
  return (
    <>
      <PlotAxes
        box={box}
        x={x}
        y={y}
        across={wholeTicks(last, box.right - box.left)}
        up={up}
        acrossName={acrossName}
        upName={upName}
        showAcross={String}
        {...(showUp ? { showUp } : {})}
      />
      {chance && <Chance chance={chance} x={x} y={y} />}
      {level && (
        <g class="level">
          <line x1={x(level.at)} x2={x(level.at)} y1={box.top} y2={box.bottom} />
          <text
            class="tick"
            x={x(level.at) + (level.at > last / 2 ? -5 : 5)}
            y={box.top + 10}
            text-anchor={level.at > last / 2 ? "end" : "start"}
          >
            {level.label}
          </text>
        </g>
      )}
      {curves.map((curve) => (
        <CurveMarks key={curve.key} curve={curve} x={x} y={y} />
      ))}
    </>
  );
}

function Chance({ chance, x, y }: { chance: ChanceBand; x: Scale; y: Scale }) {
  const points = (values: readonly number[]) => values.map((value, i) => `${x(i + 1)},${y(value)}`);
  const { mean, low, high } = chance;
  // A band of one mode is as wide as a mark.
  const [left, right] = [x(1) - 4, x(1) + 4];
  return (
    <g class="chance">
      {low && high && low.length === 1 ? (
        <rect
          class="band"
          x={left}
          width={right - left}
          y={y(high[0] ?? 0)}
          height={y(low[0] ?? 0) - y(high[0] ?? 0)}
        />
      ) : (
        low &&
        high && (
          <polygon class="band" points={[...points(low), ...points(high).reverse()].join(" ")} />
        )
      )}
      <polyline class="band-mean" points={points(mean).join(" ")} />
    </g>
  );
}

function CurveMarks({ curve, x, y }: { curve: Curve; x: Scale; y: Scale }) {
  const { key, mark, values, at, errors, line = true } = curve;
  const points = values.map((value, i) => ({
    across: x(at?.[i] ?? i + 1),
    value,
    error: errors?.[i] ?? 0,
  }));
  return (
    <g class="series" data-series={key}>
      {line && (
        <polyline points={points.map(({ across, value }) => `${across},${y(value)}`).join(" ")} />
      )}
      {points.map(({ across, value, error }, i) => (
        <g key={i}>
          {error > 0 && (
            <line
              class="error"
              x1={across}
              x2={across}
              y1={y(value - error)}
              y2={y(value + error)}
            />
          )}
          {(!line || points.length <= MOST_MARKS) && <Mark kind={mark} x={across} y={y(value)} />}
        </g>
      ))}
    </g>
  );
}

export function CurveLegend({
  curves,
  chance,
}: {
  curves: readonly Pick<Curve, "key" | "label" | "mark">[];
  chance?: ChanceBand | undefined;
}) {
  return (
    <ul class="legend" aria-hidden="true">
      {curves.map(({ key, label, mark }) => (
        <li key={key} class="series" data-series={key}>
          <svg viewBox="0 0 22 10" aria-hidden="true">
            <polyline points="0,5 22,5" />
            <Mark kind={mark} x={11} y={5} />
          </svg>
          {label}
        </li>
      ))}
      {chance && (
        <li>
          <svg viewBox="0 0 22 10" aria-hidden="true">
            {chance.low && <rect class="band" width="22" height="10" />}
            <polyline class="band-mean" points="0,5 22,5" />
          </svg>
          {chance.label}
        </li>
      )}
    </ul>
  );
}
