import { type Scale, tickText } from "../text/plots";

/** Rectangle of a plot that its data fill, in pixels. */
export interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

interface Props {
  box: Box;
  x: Scale;
  y: Scale;
  across: readonly number[];
  up: readonly number[];
  /** Names of the axes, with units. */
  acrossName: string;
  upName: string;
  showAcross?: (value: number) => string;
  showUp?: (value: number) => string;
}

/** Axes of a plot: grid lines at round values, tick labels, names. */
export function PlotAxes(props: Props) {
  const { box, x, y, across, up, acrossName, upName } = props;
  const { showAcross = tickText, showUp = tickText } = props;
  return (
    <>
      {up.map((value) => (
        <g key={value}>
          <line class="grid" x1={box.left} x2={box.right} y1={y(value)} y2={y(value)} />
          <text class="tick" x={box.left - 6} y={y(value) + 4} text-anchor="end">
            {showUp(value)}
          </text>
        </g>
      ))}
      {across.map((value) => (
        <text key={value} class="tick" x={x(value)} y={box.bottom + 15} text-anchor="middle">
          {showAcross(value)}
        </text>
      ))}
      <text class="tick axis-name" x={0} y={box.top - 9}>
        {upName}
      </text>
      <text class="tick axis-name" x={box.right} y={box.bottom + 30} text-anchor="end">
        {acrossName}
      </text>
    </>
  );
}

/** Round whole numbers from the first to the last, as many as fit into a width in pixels. */
export function wholeTicks(last: number, pixels: number): number[] {
  const most = Math.max(2, Math.floor(pixels / 48));
  const steps = [1, 2, 5, 10, 20, 25, 50, 100, 200, 250, 500, 1000, 2000, 5000, 10_000, 100_000];
  const step = steps.find((size) => last / size <= most) ?? last;
  const found = [1];
  for (let value = step; value <= last; value += step) if (value > 1) found.push(value);
  return found;
}
