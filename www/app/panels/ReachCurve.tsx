import type { Report, Side } from "../../worker/protocol";
import {
  curveOver,
  type MarkKind,
  marksText,
  outsideSentence,
  type SigmaMark,
  shareAt,
  sigmaMarks,
} from "../comparison/reach";
import { DIFFERENCE_OF } from "../state/regions";
import { onlySigmaDiffers, recommended, result, SIDES } from "../state/state";
import { number, percent } from "../text/format";
import { plain } from "../text/phrase";
import { decades, linear, logarithmic, type Scale } from "../text/plots";
import { Chart } from "../ui/Chart";
import { CurveLegend } from "../ui/Curves";
import { DataTable } from "../ui/DataTable";
import { Mark } from "../ui/Mark";
import { Phrase } from "../ui/Phrase";
import type { Box } from "../ui/PlotAxes";
import { axisOf, middleSigma, SigmaRange, shownSigma } from "./SigmaRange";

const CURVES = {
  a: { key: "a", label: "A∖B", mark: "circle" },
  b: { key: "b", label: "B∖A", mark: "square" },
} as const;

/** Heights in pixels: of a row of labels above the plot, of the plot, and of the names below. */
const [ROW, PLOT, FOOT] = [13, 92, 32];
/** Half the width of a handle, so that the line stands below the handle of the slider. */
const HALF = 8;

/** Chart of the shares outside the other model over σ, whose line for the σ in use can be dragged. */
export function ReachCurve() {
  const report = result.value?.report;
  const [middle, sigma] = [middleSigma.value, shownSigma.value];
  const curve = report?.reach?.curve;
  if (!report || !curve || curve.sigma.length === 0 || middle === null || sigma === null) {
    return null;
  }
  const { unit } = report.models.a;
  const range = axisOf(middle);
  const marks = sigmaMarks(report, recommended.value).filter(
    (mark) => mark.sigma >= range[0] && mark.sigma <= range[1],
  );
  // The largest below, so that no line crosses the label beside another one.
  const rows = [
    ...new Set([...marks].sort((one, other) => one.sigma - other.sigma).map(({ kind }) => kind)),
  ];
  const top = 4 + ROW * rows.length;
  const sentence = outsideSentence(report, sigma);
  const words = plain(sentence);
  return (
    <div class="reach-curve" data-stale={!onlySigmaDiffers.value}>
      <Chart
        name="reach-curve"
        title="Outside the other model, by σ"
        about="The share of the shapes of each model that counts as outside the other. Drag the line to another σ."
        label={`${words} ${marksText(marks, unit)}`.trim()}
        height={() => top + PLOT + FOOT}
        draw={(width) => (
          <Lines
            box={{ left: HALF, right: width - HALF, top, bottom: top + PLOT }}
            {...{ report, range, sigma, marks, rows }}
          />
        )}
        over={
          <span class="reach-handle" style={{ top: `${top}px`, bottom: `${FOOT}px` }}>
            <SigmaRange
              label="σ on the curve of the shapes outside the other model"
              words={words}
              middle={middle}
              sigma={sigma}
            />
          </span>
        }
        legend={<CurveLegend curves={[CURVES.a, CURVES.b]} />}
        table={() => (
          <DataTable
            file="reach-curve"
            caption={`Shares outside the other model, σ in ${unit}`}
            corner="Point"
            columns={[
              { title: "σ", show: number, metric: (row) => `reach.curve.sigma.${row}` },
              ...SIDES.map((side) => ({
                title: CURVES[side].label,
                show: percent,
                metric: (row: number) => `reach.curve.${DIFFERENCE_OF[side]}.${row}`,
              })),
            ]}
            rows={curve.sigma.map((one, i) => ({
              head: i + 1,
              values: [one, curve.aWithoutB[i], curve.bWithoutA[i]],
            }))}
          />
        )}
      >
        <p class="small" data-at={sigma}>
          <Phrase parts={sentence} />
        </p>
      </Chart>
    </div>
  );
}

interface LinesProps {
  box: Box;
  report: Report;
  range: readonly [number, number];
  sigma: number;
  marks: readonly SigmaMark[];
  /** Kinds of marks, each with a row for its label. */
  rows: readonly MarkKind[];
}

function Lines({ box, report, range, sigma, marks, rows }: LinesProps) {
  const x = logarithmic(...range, box.left, box.right);
  const y = linear(0, 1, box.bottom, box.top);
  const inside = sigma >= range[0] && sigma <= range[1];
  return (
    <>
      {[0, 0.5, 1].map((share) => (
        <line key={share} class="grid" x1={box.left} x2={box.right} y1={y(share)} y2={y(share)} />
      ))}
      {decades(...range).map((value) => (
        <text key={value} class="tick" x={x(value)} y={box.bottom + 14} text-anchor="middle">
          {number(value, 1)}
        </text>
      ))}
      <text class="tick axis-name" x={box.right} y={box.bottom + 28} text-anchor="end">
        σ, {report.models.a.unit}
      </text>
      {rows.map((kind, row) => (
        <MarkRow
          key={kind}
          label={kind}
          marks={marks.filter((mark) => mark.kind === kind)}
          x={x}
          box={box}
          base={10 + ROW * row}
        />
      ))}
      {SIDES.map((side) => (
        <SideCurve key={side} {...{ side, report, range, x, y }} at={inside ? sigma : null} />
      ))}
      {/* At the right end, where both curves are low. */}
      {[0.5, 1].map((share) => (
        <text key={share} class="tick inner" x={box.right} y={y(share) + 11} text-anchor="end">
          {100 * share}&#8239;%
        </text>
      ))}
      {inside && (
        <g class="at-sigma" data-kind="used">
          <line x1={x(sigma)} x2={x(sigma)} y1={box.top} y2={box.bottom} />
        </g>
      )}
    </>
  );
}

interface MarkRowProps {
  label: string;
  marks: readonly SigmaMark[];
  x: Scale;
  box: Box;
  base: number;
}

/** Width of a letter of a label in pixels, at most. */
const LETTER = 6.2;

/** Lines of one kind of marks, with a label beside them. */
function MarkRow({ label, marks, x, box, base }: MarkRowProps) {
  const places = marks.map(({ sigma }) => x(sigma));
  const [first, last] = [Math.min(...places), Math.max(...places)];
  const fits = last + 4 + LETTER * label.length < box.right;
  return (
    <g class="sigma-mark" data-kind={label}>
      {marks.map(({ side, sigma }) => (
        <line
          key={side}
          data-side={side}
          x1={x(sigma)}
          x2={x(sigma)}
          y1={base - 8}
          y2={box.bottom}
        />
      ))}
      <text
        class="tick"
        x={fits ? last + 4 : first - 4}
        y={base}
        text-anchor={fits ? "start" : "end"}
      >
        {label}
      </text>
    </g>
  );
}

interface SideCurveProps {
  side: Side;
  report: Report;
  range: readonly [number, number];
  x: Scale;
  y: Scale;
  /** The σ with a mark, if it is on the axis. */
  at: number | null;
}

function SideCurve({ side, report, range, x, y, at }: SideCurveProps) {
  const curve = report.reach?.curve;
  if (!curve) return null;
  const points = curveOver(curve, side, range);
  return (
    <g class="series" data-series={side}>
      <polyline points={points.map(([sigma, share]) => `${x(sigma)},${y(share)}`).join(" ")} />
      {at !== null && <Mark kind={CURVES[side].mark} x={x(at)} y={y(shareAt(curve, side, at))} />}
    </g>
  );
}
