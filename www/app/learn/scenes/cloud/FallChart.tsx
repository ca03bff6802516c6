import type { LessonIntersection } from "../../../../worker/protocol";
import { count, number } from "../../../text/format";
import { logarithmic } from "../../../text/plots";
import { Chart } from "../../../ui/Chart";
import { DataTable } from "../../../ui/DataTable";
import { type Box, PlotAxes } from "../../../ui/PlotAxes";
import { letterSpace } from "../../parts/lettering";
import { logRange, logTicks } from "../../sampling/axes";

interface Point {
  draws: number;
  found: number | null;
  predicted: number | null;
}

/** Plot of d_G over the number of draws on logarithmic axes, where 1/√N is a straight line. */
export function FallChart({ found, most }: { found: LessonIntersection; most: number }) {
  const points: Point[] = found.falls.map(({ draws, grassmann }, i) => ({
    draws,
    found: grassmann,
    predicted: found.predicted[i] ?? null,
  }));
  const { closedForm } = found;
  const last = points.at(-1);
  return (
    <Chart
      name="fall"
      title="Error of the model over the number of draws"
      about="Grassmann distance d_G between the model of the draws and the true intersection, both axes logarithmic."
      label={`d_G to the known intersection, ${number(last?.found ?? Number.NaN)} after ${count(last?.draws ?? 0)} draws of each model; the closed form has ${number(closedForm ?? Number.NaN)}.`}
      height={(width) => Math.round(Math.min(300, Math.max(210, 0.55 * width)))}
      draw={(width) => <Lines points={points} closedForm={closedForm} width={width} most={most} />}
      legend={
        <ul class="legend fall-legend">
          <li data-series="found">found</li>
          <li data-series="predicted">sampling noise alone, 1/√N</li>
          <li data-series="closed">closed form, no draws</li>
        </ul>
      }
      table={() => (
        <DataTable
          file="grassmann-over-draws"
          caption="d_G over draws of each model"
          corner="Draws"
          columns={[
            { title: "found", metric: (row) => `intersection.falls.${row}.grassmann` },
            { title: "predicted", metric: (row) => `intersection.predicted.${row}` },
          ]}
          rows={points.map((point) => ({
            head: count(point.draws),
            values: [point.found, point.predicted],
          }))}
        />
      )}
    />
  );
}

interface LinesProps {
  points: readonly Point[];
  closedForm: number | null;
  width: number;
  most: number;
}

function Lines({ points, closedForm, width, most }: LinesProps) {
  const height = Math.round(Math.min(300, Math.max(210, 0.55 * width)));
  const box: Box = {
    left: letterSpace(52),
    right: width - letterSpace(16),
    top: letterSpace(24),
    bottom: height - letterSpace(40),
  };
  const [low, high] = logRange([
    closedForm,
    ...points.flatMap(({ found, predicted }) => [found, predicted]),
  ]);
  const first = points[0]?.draws ?? 1;
  const end = Math.max(most, first * 2);
  const x = logarithmic(first, end, box.left + 6, box.right - 6);
  const y = logarithmic(low, high, box.bottom, box.top);
  const path = (pick: (point: Point) => number | null) =>
    points
      .flatMap((point) => {
        const value = pick(point);
        return value !== null && value > 0 ? [`${x(point.draws)},${y(value)}`] : [];
      })
      .join(" ");
  return (
    <g class="fall">
      <PlotAxes
        box={box}
        x={x}
        y={y}
        across={logTicks(first, end).filter((value) => value >= first)}
        up={logTicks(low, high)}
        acrossName=""
        upName="d_G"
        showAcross={count}
        showUp={(value) => number(value, 1)}
      />
      <text class="tick axis-name" x={box.right} y={box.bottom + letterSpace(30)} text-anchor="end">
        draws of each model
      </text>
      {closedForm !== null && (
        <line class="closed" x1={box.left} x2={box.right} y1={y(closedForm)} y2={y(closedForm)} />
      )}
      <polyline class="predicted" points={path((point) => point.predicted)} />
      <polyline class="found" points={path((point) => point.found)} />
      {points.map(
        ({ draws, found }) =>
          found !== null && <circle key={draws} class="found" cx={x(draws)} cy={y(found)} r={4} />,
      )}
    </g>
  );
}
