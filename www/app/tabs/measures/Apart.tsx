import type { RelationReport, Report } from "../../../worker/protocol";
import { divergence, noiseSentence } from "../../comparison/measured";
import { length, number } from "../../text/format";
import { DataTable } from "../../ui/DataTable";
import { Phrase } from "../../ui/Phrase";

/** Shows rounding error as 0. */
const radians = (value: number) => (value < 1e-9 ? "0" : number(value, 4));

const ROWS = [
  { head: "A∩B and A", name: "toA" },
  { head: "A∩B and B", name: "toB" },
  { head: "A∩B and the union of A and B", name: "toUnion" },
] as const;

/** Table of the Grassmann distances between A, B, A∩B and their union. */
export function GrassmannDistances({
  report,
  relation,
}: {
  report: Report;
  relation: RelationReport | null;
}) {
  const { grassmann, grassmannAffine } = report.intersection;
  const direct = relation && relation.problem === null ? relation : null;
  const path = (of: string) => (row: number) => {
    const name = ROWS[row]?.name;
    return name && `intersection.${of}.${name}`;
  };
  return (
    <section class="chart half" data-chart="grassmann">
      <h3>Grassmann distance</h3>
      <p class="small">
        Symmetric distance between two shape spaces, computed from their principal angles. The
        paper’s variant ignores the distance of a space from the origin and compares only as many
        modes as the smaller space has; the affine variant (Lim, Wong &amp; Ye) takes account of
        both.
      </p>
      <DataTable
        file="grassmann-distances"
        caption="Grassmann distance, radians"
        corner="Between"
        columns={[
          { title: "paper", show: radians, metric: path("grassmann") },
          { title: "affine", show: radians, metric: path("grassmannAffine") },
        ]}
        rows={[
          ...ROWS.map(({ head, name }) => ({
            head,
            values: [grassmann[name], grassmannAffine[name]],
          })),
          ...(direct
            ? [{ head: "A and B", values: [direct.grassmann, direct.grassmannAffine] }]
            : []),
        ]}
      />
    </section>
  );
}

/** Table of the Bhattacharyya distance and the Kullback–Leibler divergences of the two Gaussians. */
export function Divergences({ report }: { report: Report }) {
  const { bhattacharyya, bhattacharyyaNoise, kullbackLeibler } = report.overlap;
  const rows = [
    { head: "Bhattacharyya distance", value: bhattacharyya, path: "overlap.bhattacharyya" },
    ...(kullbackLeibler
      ? [
          {
            head: "KL(A‖B), A described by B",
            value: kullbackLeibler.aFromB,
            path: "overlap.kullbackLeibler.aFromB",
          },
          {
            head: "KL(B‖A), B described by A",
            value: kullbackLeibler.bFromA,
            path: "overlap.kullbackLeibler.bFromA",
          },
        ]
      : []),
  ];
  const noise = {
    head: `Noise τ, ${report.models.a.unit}`,
    value: bhattacharyyaNoise,
    path: "overlap.bhattacharyyaNoise",
  };
  const all = [...rows, noise];
  return (
    <section class="chart half" data-chart="divergences">
      <h3>Bhattacharyya and Kullback–Leibler</h3>
      <p class="small">
        <Phrase parts={noiseSentence(report)} />
      </p>
      <DataTable
        file="divergences"
        caption={`Between the Gaussians of A and B, in nats, at τ = ${length(bhattacharyyaNoise, report.models.a.unit)}`}
        corner="Measure"
        columns={[{ title: "Value", show: divergence, metric: (row) => all[row]?.path }]}
        rows={all.map(({ head, value }) => ({ head, values: [value] }))}
      />
    </section>
  );
}
