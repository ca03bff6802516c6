import type { Report } from "../../../worker/protocol";
import { compactnessSentence } from "../../comparison/measured";
import { exclusive } from "../../comparison/words";
import { number, percent } from "../../text/format";
import { type Curve, CurveChart } from "../../ui/Curves";
import { DataTable } from "../../ui/DataTable";
import { Phrase } from "../../ui/Phrase";

/** Compactness curves of A, B and A∩B. */
export function Compactness({ report }: { report: Report }) {
  const found = report.compactness;
  if (!found) return null;
  const curves: Curve[] = [
    { key: "a", label: "A", mark: "circle", values: found.a },
    { key: "b", label: "B", mark: "square", values: found.b },
    { key: "intersection", label: "A∩B", mark: "diamond", values: found.intersection },
  ];
  const names = ["a", "b", "intersection"] as const;
  const modes = Math.max(...curves.map(({ values }) => values.length));
  const sentence = compactnessSentence(found);
  return (
    <CurveChart
      name="compactness"
      title="Compactness"
      about={`Share of the variance that the first modes of each model explain. ${sentence}`}
      label={`Compactness curves of A, B and A∩B. ${sentence}`}
      plot={{
        height: 226,
        curves,
        acrossName: "modes",
        upName: "share of the variance",
        top: 1,
        up: [0, 0.25, 0.5, 0.75, 1],
        showUp: (value) => `${100 * value}\u202f%`,
      }}
      table={() => (
        <DataTable
          file="compactness"
          caption="Share of the variance that the first modes explain"
          corner="Modes"
          columns={names.map((name, i) => ({
            title: curves[i]?.label ?? name,
            show: percent,
            metric: (row) => `compactness.${name}.${row}`,
          }))}
          rows={Array.from({ length: modes }, (_, i) => ({
            head: i + 1,
            values: names.map((name) => found[name][i]),
          }))}
        />
      )}
    />
  );
}

/** Exclusive spectrum: for each exclusive mode of a model, the residual of one SD in the other model. */
export function ExclusiveSpectrum({ report }: { report: Report }) {
  const { aWithoutB, bWithoutA } = report.differences;
  const [a, b] = [aWithoutB.exclusive?.residualSd ?? [], bWithoutA.exclusive?.residualSd ?? []];
  if (a.length + b.length === 0) return null;
  const { unit } = report.models.a;
  const curves: Curve[] = [
    { key: "a", label: "A, missed by B", mark: "circle", values: a },
    { key: "b", label: "B, missed by A", mark: "square", values: b },
  ];
  const sentences = (["a", "b"] as const).map((side) => exclusive(report, side));
  return (
    <CurveChart
      name="exclusive"
      title="Exclusive spectrum"
      about={
        <>
          Directions of each model ordered by the part of one standard deviation that the other
          model cannot make, RMS over the points.{" "}
          {sentences.map(
            (sentence, i) =>
              sentence && (
                <span key={i}>
                  <Phrase parts={sentence} />{" "}
                </span>
              ),
          )}
        </>
      }
      label={`Exclusive modes: of A from ${number(a[0] ?? 0)} ${unit} down to ${number(a.at(-1) ?? 0)}, of B from ${number(b[0] ?? 0)} down to ${number(b.at(-1) ?? 0)}.`}
      plot={{
        height: 226,
        curves,
        acrossName: "exclusive mode",
        upName: `residual of one SD, ${unit}`,
      }}
      table={() => (
        <DataTable
          file="exclusive-modes"
          caption={`Residual of one standard deviation of each exclusive mode, ${unit}`}
          corner="Mode"
          columns={[
            {
              title: "A, missed by B",
              metric: (row) => `differences.aWithoutB.exclusive.residualSd.${row}`,
            },
            {
              title: "B, missed by A",
              metric: (row) => `differences.bWithoutA.exclusive.residualSd.${row}`,
            },
          ]}
          rows={Array.from({ length: Math.max(a.length, b.length) }, (_, i) => ({
            head: i + 1,
            values: [a[i], b[i]],
          }))}
        />
      )}
    />
  );
}
