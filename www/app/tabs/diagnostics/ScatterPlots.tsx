import type { PairPlots } from "../../../worker/protocol";
import {
  deviation,
  ellipseOf,
  type Gaussian,
  gaussianShare,
  pairsOf,
  shareWithin,
} from "../../comparison/diagnosing";
import { count, percent } from "../../text/format";
import { linear, type Scale, ticks, tickText } from "../../text/plots";
import type { Advice } from "../../ui/Chart";
import { Chart } from "../../ui/Chart";
import { PairTables } from "./PairTables";

interface Props {
  diagnostics: PairPlots;
  advice: Advice;
  /** “A” */
  model: string;
  file: string;
}

/** Scatter plots of all pairs of the first coefficients, with the ellipses of their moments and of the Gaussian fit. */
export function ScatterPlots({ diagnostics, advice, model, file }: Props) {
  const { modes, count: drawn, fit } = diagnostics;
  const pairs = pairsOf(modes.length);
  if (pairs.length === 0) return null;
  const shares = pairs.map(([i, j]) => shareWithin(diagnostics, i, j, 2));
  const share = shares.reduce((sum, value) => sum + value, 0) / shares.length;
  return (
    <Chart
      name="pairs"
      title="Pairs of modes"
      about={`${count(drawn)} of the draws in the first ${modes.length} modes of ${model}, in standard deviations of ${model}. Ellipses of 1 and 2 standard deviations: the mean and covariance used for A∩B${fit ? ", and the Gaussian fit" : "; the Gaussian fit of a stored comparison is not kept"}.`}
      label={`Pair plots of the first ${modes.length} modes of ${model}: ${count(drawn)} draws, ${percent(share)} of them within 2 standard deviations, where a Gaussian has ${percent(gaussianShare(2))}.`}
      height={(width) => cellOf(modes.length, width).height}
      draw={(width) => <Triangle diagnostics={diagnostics} width={width} />}
      legend={<PairLegend fit={fit !== null} />}
      advice={advice}
      table={() => (
        <PairTables
          diagnostics={diagnostics}
          pairs={pairs}
          shares={shares}
          model={model}
          file={file}
        />
      )}
    />
  );
}

const LEFT = 40;
const GAP = 8;
const FOOT = 36;

function cellOf(modes: number, width: number) {
  const cells = modes - 1;
  const size = Math.min(156, (width - LEFT - GAP * (cells - 1)) / cells);
  return { size, height: cells * size + (cells - 1) * GAP + FOOT };
}

function Triangle({ diagnostics, width }: { diagnostics: PairPlots; width: number }) {
  const { modes, count: drawn, draws, fit } = diagnostics;
  const { size } = cellOf(modes.length, width);
  const column = (mode: number) =>
    Array.from({ length: drawn }, (_, draw) => draws[draw * modes.length + mode] ?? 0);
  const columns = modes.map((_, mode) => column(mode));
  const ranges = columns.map((values, mode) => rangeOf(values, diagnostics, fit, mode));
  const last = modes.length - 1;
  return (
    <>
      {pairsOf(modes.length).map(([i, j]) => {
        const [left, top] = [LEFT + i * (size + GAP), (j - 1) * (size + GAP)];
        const x = linear(...(ranges[i] ?? [0, 1]), left, left + size);
        const y = linear(...(ranges[j] ?? [0, 1]), top + size, top);
        const dots = (columns[i] ?? [])
          .map(
            (value, draw) => `M${x(value).toFixed(1)} ${y(columns[j]?.[draw] ?? 0).toFixed(1)}h0`,
          )
          .join("");
        return (
          <g key={`${i} ${j}`} class="pair-cell">
            <rect class="cell" x={left} y={top} width={size} height={size} />
            <path class="dots" d={dots} />
            {fit && <Ellipses gaussian={fit} i={i} j={j} x={x} y={y} kind="fit" />}
            <Ellipses gaussian={diagnostics} i={i} j={j} x={x} y={y} kind="moments" />
            {i === 0 && (
              <Side
                range={ranges[j] ?? [0, 1]}
                scale={y}
                at={left}
                middle={top + size / 2}
                mode={j}
              />
            )}
            {j === last && (
              <Foot
                range={ranges[i] ?? [0, 1]}
                scale={x}
                top={top + size}
                left={left}
                size={size}
                mode={i}
              />
            )}
          </g>
        );
      })}
    </>
  );
}

function rangeOf(
  values: number[],
  moments: Gaussian,
  fit: Gaussian | null,
  mode: number,
): [number, number] {
  const ends = (fit ? [moments, fit] : [moments]).flatMap((gaussian) => {
    const reach = 2 * deviation(gaussian, mode);
    return [(gaussian.mean[mode] ?? 0) - reach, (gaussian.mean[mode] ?? 0) + reach];
  });
  const [low, high] = [Math.min(...values, ...ends), Math.max(...values, ...ends)];
  const margin = 0.05 * (high - low) || 1;
  return [low - margin, high + margin];
}

interface EllipsesProps {
  gaussian: Gaussian;
  i: number;
  j: number;
  x: Scale;
  y: Scale;
  kind: "fit" | "moments";
}

/** Ellipses drawn as polygons: the two axes have different scales, which would change the angle of an SVG ellipse. */
function Ellipses({ gaussian, i, j, x, y, kind }: EllipsesProps) {
  const { x: cx, y: cy, long, short, angle } = ellipseOf(gaussian, i, j);
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const outline = (deviations: number) =>
    Array.from({ length: 72 }, (_, step) => {
      const turn = (2 * Math.PI * step) / 72;
      const [u, v] = [deviations * long * Math.cos(turn), deviations * short * Math.sin(turn)];
      return `${x(cx + u * cos - v * sin).toFixed(1)},${y(cy + u * sin + v * cos).toFixed(1)}`;
    }).join(" ");
  return (
    <g class="ellipses" data-kind={kind}>
      <polygon points={outline(1)} />
      <polygon points={outline(2)} />
    </g>
  );
}

interface SideProps {
  range: [number, number];
  scale: Scale;
  at: number;
  middle: number;
  mode: number;
}

const few = ([low, high]: [number, number]) =>
  ticks(low, high, 3).filter((value) => value >= low && value <= high);

function Side({ range, scale, at, middle, mode }: SideProps) {
  return (
    <>
      {few(range).map((value) => (
        <text key={value} class="tick" x={at - 4} y={scale(value) + 4} text-anchor="end">
          {tickText(value)}
        </text>
      ))}
      <text
        class="tick axis-name"
        text-anchor="middle"
        transform={`translate(10 ${middle}) rotate(-90)`}
      >
        mode {mode + 1}
      </text>
    </>
  );
}

interface FootProps {
  range: [number, number];
  scale: Scale;
  top: number;
  left: number;
  size: number;
  mode: number;
}

function Foot({ range, scale, top, left, size, mode }: FootProps) {
  return (
    <>
      {few(range).map((value) => (
        <text key={value} class="tick" x={scale(value)} y={top + 14} text-anchor="middle">
          {tickText(value)}
        </text>
      ))}
      <text class="tick axis-name" x={left + size / 2} y={top + 30} text-anchor="middle">
        mode {mode + 1}
      </text>
    </>
  );
}

function PairLegend({ fit }: { fit: boolean }) {
  return (
    <ul class="legend" aria-hidden="true">
      <li>
        <svg viewBox="0 0 22 10" aria-hidden="true" class="pair-cell">
          <path class="dots" d="M4 7h0M9 4h0M14 6h0M18 3h0" />
        </svg>
        draws
      </li>
      <li class="ellipses" data-kind="moments">
        <svg viewBox="0 0 22 10" aria-hidden="true">
          <polyline points="0,5 22,5" />
        </svg>
        moments, 1 and 2 SD
      </li>
      {fit && (
        <li class="ellipses" data-kind="fit">
          <svg viewBox="0 0 22 10" aria-hidden="true">
            <polyline points="0,5 22,5" />
          </svg>
          Gaussian fit, 1 and 2 SD
        </li>
      )}
    </ul>
  );
}
