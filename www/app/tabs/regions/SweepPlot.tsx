import type { SweepPoint } from "../../../worker/protocol";
import { recommended, settings, unit } from "../../state/state";
import { length, number } from "../../text/format";
import { decades, linear, logarithmic, ticks } from "../../text/plots";
import { CurveLegend } from "../../ui/Curves";
import { Mark } from "../../ui/Mark";
import { SaveTable } from "../../ui/SaveTable";

const BOX = { left: 34, right: 8, top: 20, bottom: 34 };

const SERIES = [
  { key: "distance", label: "predicted mean distance", mark: "circle" },
  { key: "nearest", label: "nearest common shape", mark: "square" },
  { key: "vertexSd", label: "SD per vertex", mark: "diamond" },
] as const;

interface Props {
  points: SweepPoint[];
  width: number;
  height: number;
}

/** Plot of distance, nearest common shape and SD per vertex over σ, with the recommended σ and the one in use. */
export function SweepLines({ points, width, height }: Props) {
  const sigmas = points.map((point) => point.sigma);
  const [least, most] = [Math.min(...sigmas), Math.max(...sigmas)];
  const x = logarithmic(least, most, BOX.left, width - BOX.right);
  const highest = Math.max(...points.flatMap((point) => SERIES.map(({ key }) => point[key])));
  const steps = ticks(0, highest, 4);
  const top = Math.max(highest, steps.at(-1) ?? 0);
  const y = linear(0, top, height - BOX.bottom, BOX.top);
  const used = settings.value.sigma ?? recommended.value;
  const marks = [
    { sigma: recommended.value, label: "recommended", kind: "recommended" },
    { sigma: used === recommended.value ? null : used, label: "in use", kind: "used" },
  ];
  return (
    <>
      {steps.map((value) => (
        <g key={value}>
          <line class="grid" x1={BOX.left} x2={width - BOX.right} y1={y(value)} y2={y(value)} />
          <text class="tick" x={BOX.left - 5} y={y(value) + 3} text-anchor="end">
            {number(value, 2)}
          </text>
        </g>
      ))}
      <text class="tick" x={0} y={BOX.top - 7}>
        {unit.value}
      </text>
      {decades(least, most).map((sigma) => (
        <text
          key={sigma}
          class="tick"
          x={x(sigma)}
          y={height - BOX.bottom + 13}
          text-anchor="middle"
        >
          {number(sigma, 1)}
        </text>
      ))}
      <text class="tick" x={(BOX.left + width) / 2} y={height - 5} text-anchor="middle">
        σ in {unit.value}, logarithmic
      </text>
      {marks.map(({ sigma, label, kind }) =>
        sigma === null || x(sigma) < BOX.left || x(sigma) > width - BOX.right ? null : (
          <g key={kind} class="at-sigma" data-kind={kind}>
            <line x1={x(sigma)} x2={x(sigma)} y1={BOX.top} y2={height - BOX.bottom} />
            <text
              class="tick"
              x={x(sigma)}
              y={BOX.top - 7}
              text-anchor={anchor(kind, used, recommended.value)}
            >
              {label}
            </text>
          </g>
        ),
      )}
      {SERIES.map(({ key, mark }) => (
        <g key={key} class="series" data-series={key}>
          <polyline
            points={points.map((point) => `${x(point.sigma)},${y(point[key])}`).join(" ")}
          />
          {points.map((point) => (
            <Mark key={point.sigma} kind={mark} x={x(point.sigma)} y={y(point[key])} />
          ))}
        </g>
      ))}
    </>
  );
}

export function SweepLegend() {
  return <CurveLegend curves={SERIES} />;
}

/** Alignment of the two labels, away from one another. */
function anchor(
  kind: string,
  used: number | null,
  theirs: number | null,
): "start" | "middle" | "end" {
  if (used === null || theirs === null || used === theirs) return "middle";
  return (kind === "used") === used < theirs ? "end" : "start";
}

export function SweepTable({ points }: { points: SweepPoint[] }) {
  const columns: [string, (point: SweepPoint) => number][] = [
    ["Distance", (point) => point.distance],
    ["Dimensions", (point) => point.effectiveDimensions],
    ["d_G to A", (point) => point.grassmann.toA],
    ["to B", (point) => point.grassmann.toB],
    ["to union", (point) => point.grassmann.toUnion],
  ];
  return (
    <SaveTable file="sigma-sweep" of="the σ sweep">
      <table class="numbers sweep-table" data-columns="5">
        <caption>
          σ and distance in {unit.value}, dimensions on which the distance acts, and Grassmann
          distances of A∩B in radians
        </caption>
        <thead>
          <tr>
            <th scope="col">σ</th>
            {columns.map(([name]) => (
              <th key={name} scope="col">
                {name}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {points.map((point) => (
            <tr key={point.sigma} data-sigma={point.sigma}>
              <th scope="row">{number(point.sigma)}</th>
              {columns.map(([name, of]) => (
                <td
                  key={name}
                  data-value={of(point)}
                  title={name === "Distance" ? length(of(point), unit.value) : undefined}
                >
                  {number(of(point))}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </SaveTable>
  );
}
