import { count, number } from "../../../text/format";
import { linear, ticks } from "../../../text/plots";
import { Chart } from "../../../ui/Chart";
import { type Box, PlotAxes } from "../../../ui/PlotAxes";
import { letterSpace } from "../../parts/lettering";
import type { Moment } from "./run";

const HEIGHT = 230;
/** Limit of the walk without its Hastings factor for 50 coefficients, from a long run. */
const WITHOUT = 0.53;

/** Plot of E‖α‖²/q of both random walks over the steps; 1 is right. */
export function SquareChart({ curve, most }: { curve: readonly Moment[]; most: number }) {
  const last = curve.at(-1);
  const [published = Number.NaN, corrected = Number.NaN] = last?.meanSquares ?? [];
  return (
    <Chart
      name="squares"
      title="E‖α‖²/q of all draws so far"
      about="1 for the target. Without the Hastings factor of the scaling move the walk converges to 0.53."
      label={`Mean of ‖α‖²/q after ${count(last?.step ?? 0)} steps: ${number(published)} as published, ${number(corrected)} corrected; 1 is right.`}
      height={() => HEIGHT}
      draw={(width) => <Curves curve={curve} most={most} width={width} />}
      legend={
        <ul class="legend square-legend">
          <li data-series="published">as published</li>
          <li data-series="corrected">corrected</li>
        </ul>
      }
    />
  );
}

function Curves({ curve, most, width }: { curve: readonly Moment[]; most: number; width: number }) {
  const box: Box = {
    left: letterSpace(40),
    right: width - 12,
    top: letterSpace(24),
    bottom: HEIGHT - letterSpace(40),
  };
  const x = linear(0, most, box.left, box.right);
  const y = linear(0.4, 1.2, box.bottom, box.top);
  const line = (which: number) =>
    curve
      .flatMap(({ step, meanSquares }) => {
        const value = meanSquares[which];
        return value === undefined ? [] : [`${x(step)},${y(Math.min(1.2, Math.max(0.4, value)))}`];
      })
      .join(" ");
  return (
    <g class="squares">
      <PlotAxes
        box={box}
        x={x}
        y={y}
        across={ticks(0, most, 4).filter((value) => value <= most)}
        up={[0.4, 0.6, 0.8, 1]}
        acrossName=""
        upName="E‖α‖²/q"
        showAcross={count}
      />
      <text class="tick axis-name" x={box.right} y={box.bottom + letterSpace(30)} text-anchor="end">
        steps after burn-in
      </text>
      <line class="right" x1={box.left} x2={box.right} y1={y(1)} y2={y(1)} />
      <line class="wrong-level" x1={box.left} x2={box.right} y1={y(WITHOUT)} y2={y(WITHOUT)} />
      <polyline class="published" points={line(0)} />
      <polyline class="corrected" points={line(1)} />
    </g>
  );
}
