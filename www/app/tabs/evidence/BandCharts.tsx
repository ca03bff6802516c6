import type { Band, EvidenceReport } from "../../../worker/protocol";
import { bandSentence } from "../../comparison/groups";
import { degrees, number, percent } from "../../text/format";
import { CurveChart } from "../../ui/Curves";
import { DataTable } from "../../ui/DataTable";
import { InTurn } from "../../ui/InTurn";

interface BandPlot {
  /** Path in the bands of the report. */
  path: string;
  band: Band;
  series: "a" | "b" | "intersection";
  title: string;
  about: string;
  across: string;
  up: string;
  show: (value: number) => string;
  /** Upper end and ticks of the plot, if fixed. */
  top?: number;
  ticks?: number[];
}

const SHARES = { top: 1, ticks: [0, 0.25, 0.5, 0.75, 1] };

function plots({ bands }: EvidenceReport, unit: string): BandPlot[] {
  const sides = (["a", "b"] as const).map((side) => ({
    side,
    name: side.toUpperCase(),
    other: side === "a" ? "B" : "A",
  }));
  return [
    ...sides.map(({ side, name, other }) => ({
      path: `sharedVariance.${side}`,
      band: bands.sharedVariance[side],
      series: side,
      title: `Variance of ${name} inside ${other}`,
      about: `Share of the variance of ${name} in the first modes of ${other}.`,
      across: `first modes of ${other}`,
      up: "share of the variance",
      show: percent,
      ...SHARES,
    })),
    ...sides.map(({ side, name, other }) => ({
      path: `exclusiveModes.${side}`,
      band: bands.exclusiveModes[side],
      series: side,
      title: `Exclusive modes of ${name}`,
      about: `What one standard deviation of ${name} leaves outside ${other}, root mean square over the points.`,
      across: "exclusive mode",
      up: `residual, ${unit}`,
      show: (value: number) => number(value),
    })),
    ...sides.map(({ side, name }) => ({
      path: `standardDeviations.${side}`,
      band: bands.standardDeviations[side],
      series: side,
      title: `Spectrum of ${name}`,
      about: `Standard deviations of the modes of ${name}, of the whole shape vector.`,
      across: "mode",
      up: `standard deviation, ${unit}`,
      show: (value: number) => number(value),
    })),
    {
      path: "principalAnglesDegrees",
      band: bands.principalAnglesDegrees,
      series: "intersection",
      title: "Principal angles",
      about: "Between the first modes of both groups.",
      across: "direction, most alike first",
      up: "degrees",
      show: degrees,
      top: 90,
      ticks: [0, 30, 60, 90],
    },
  ];
}

/** Curves of both groups with their band of chance: shared variance, exclusive modes, spectra, angles. */
export function BandCharts({ evidence, unit }: { evidence: EvidenceReport; unit: string }) {
  return (
    <InTurn
      parts={plots(evidence, unit).map((plot) => <BandChart key={plot.path} plot={plot} />)}
    />
  );
}

function BandChart({ plot }: { plot: BandPlot }) {
  const { path, band, series, title, about, across, up, show, top, ticks } = plot;
  const sentence = bandSentence(band);
  const columns = ["observed", "mean", "p05", "p95"] as const;
  const titles = { observed: "observed", mean: "by chance", p05: "5 %", p95: "95 %" };
  return (
    <CurveChart
      name={`band-${path.replace(".", "-")}`}
      title={title}
      about={about}
      label={`${title}. ${sentence}`}
      plot={{
        height: 206,
        curves: [{ key: series, label: "observed", mark: "circle", values: band.observed }],
        chance: { label: "by chance, 5 to 95 %", mean: band.mean, low: band.p05, high: band.p95 },
        acrossName: across,
        upName: up,
        ...(top === undefined ? {} : { top, up: ticks ?? [], showUp: show }),
      }}
      table={() => (
        <DataTable
          file={`band-${path.replace(".", "-")}`}
          caption={`${title}, observed and by chance`}
          corner="Mode"
          columns={columns.map((column) => ({
            title: titles[column],
            show,
            metric: (row) => `evidence.bands.${path}.${column}.${row}`,
          }))}
          rows={band.observed.map((_, i) => ({
            head: i + 1,
            values: columns.map((column) => band[column][i]),
          }))}
        />
      )}
    >
      <p class="small">{sentence}</p>
    </CurveChart>
  );
}
