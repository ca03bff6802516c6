import type { ChainPlots } from "../../../worker/protocol";
import { drawsOf, insignificantLag, noiseBand } from "../../comparison/diagnosing";
import { number } from "../../text/format";
import { linear, ticks } from "../../text/plots";
import type { Advice } from "../../ui/Chart";
import { Chart } from "../../ui/Chart";
import { DataTable } from "../../ui/DataTable";
import { PlotAxes } from "../../ui/PlotAxes";

interface Props {
  diagnostics: ChainPlots;
  advice: Advice;
  which: string;
  file: string;
}

/** Autocorrelation plot of one coefficient, by lag. */
export function Correlation({ diagnostics, advice, which, file }: Props) {
  const found = Array.from(diagnostics.autocorrelation);
  const draws = drawsOf(diagnostics);
  const band = noiseBand(draws);
  const silent = insignificantLag(found, draws);
  return (
    <Chart
      name="autocorrelation"
      title="Autocorrelation"
      about={`Correlation of draws of ${which} at each lag within a chain, averaged over the chains. Within the band, ±2/√N = ±${number(band, 2)}, it is not significant.`}
      label={`Autocorrelation of ${which}: ${number(found[1] ?? 0, 2)} at lag 1, ${
        silent === null
          ? `still significant at lag ${found.length - 1}`
          : `not significant from lag ${silent} on`
      }; the band is ±${number(band, 2)}.`}
      height={() => 206}
      draw={(width) => <Stems found={found} band={band} width={width} />}
      advice={advice}
      table={() => (
        <DataTable
          file={file}
          caption={`Autocorrelation of ${which}`}
          corner="Lag"
          columns={[{ title: "Correlation" }]}
          rows={found.map((value, lag) => ({ head: lag, values: [value] }))}
        />
      )}
    />
  );
}

function Stems({ found, band, width }: { found: number[]; band: number; width: number }) {
  const box = { left: 36, right: width - 8, top: 24, bottom: 170 };
  const low = Math.min(-1.5 * band, ...found);
  const x = linear(0, Math.max(1, found.length - 1), box.left + 6, box.right - 4);
  const y = linear(low, 1, box.bottom, box.top);
  const step = Math.min(9, (x(1) - x(0)) * 0.6);
  return (
    <>
      <PlotAxes
        box={box}
        x={x}
        y={y}
        across={ticks(0, found.length - 1, 5).filter(
          (lag) => lag < found.length && Number.isInteger(lag),
        )}
        up={[0, 0.5, 1]}
        acrossName="lag, in kept draws"
        upName="correlation"
        showAcross={String}
      />
      <rect
        class="noise"
        x={box.left}
        y={y(band)}
        width={box.right - box.left}
        height={y(-band) - y(band)}
      />
      <g class="stems">
        {found.map((value, lag) => (
          <rect
            key={lag}
            x={x(lag) - step / 2}
            y={Math.min(y(value), y(0))}
            width={step}
            height={Math.max(1, Math.abs(y(value) - y(0)))}
            data-noise={Math.abs(value) < band}
          />
        ))}
      </g>
    </>
  );
}
