import type { Report } from "../../../worker/protocol";
import { shareSentence } from "../../comparison/measured";
import type { Nouns } from "../../state/demos";
import { percent } from "../../text/format";
import { Chart } from "../../ui/Chart";
import { DataTable } from "../../ui/DataTable";

const SHARES = [
  { side: "a", path: "overlap.varianceOfAInB", label: "of A’s variance, B can make" },
  { side: "b", path: "overlap.varianceOfBInA", label: "of B’s variance, A can make" },
] as const;

const [ROW, BAR] = [46, 20];

/** Bars of the share of each model's variance that the other model can make. */
export function VarianceBars({ report, nouns }: { report: Report; nouns: Nouns }) {
  const { varianceOfAInB, varianceOfBInA } = report.overlap;
  const values = { a: varianceOfAInB, b: varianceOfBInA };
  return (
    <Chart
      name="shares"
      title="Shared variance"
      about={shareSentence(nouns)}
      label={`B can make ${percent(values.a)} of the variance of A, A can make ${percent(values.b)} of that of B.`}
      height={() => 2 * ROW}
      draw={(width) =>
        SHARES.map(({ side, label }, row) => (
          <g key={side} class="share" data-side={side} transform={`translate(0 ${row * ROW})`}>
            <text x={0} y={14} class="share-name">
              <tspan class="share-value">{percent(values[side])}</tspan> {label}
            </text>
            <rect data-part="whole" x={0.5} y={22} width={width - 1} height={BAR - 4} rx={4} />
            <rect
              data-part="made"
              x={0}
              y={21.5}
              width={width * values[side]}
              height={BAR - 3}
              rx={4}
            />
          </g>
        ))
      }
      table={() => (
        <DataTable
          file="shared-variance"
          caption="Share of the variance that the other model can make"
          corner="Of"
          columns={[{ title: "Share", show: percent, metric: (row) => SHARES[row]?.path }]}
          rows={SHARES.map(({ side }) => ({ head: side.toUpperCase(), values: [values[side]] }))}
        />
      )}
    />
  );
}
