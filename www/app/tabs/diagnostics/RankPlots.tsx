import type { ChainPlots } from "../../../worker/protocol";
import { chainsOf, rankBand, shownChains } from "../../comparison/diagnosing";
import { count } from "../../text/format";
import type { Advice } from "../../ui/Chart";
import { Chart } from "../../ui/Chart";
import { DataTable } from "../../ui/DataTable";

interface Props {
  diagnostics: ChainPlots;
  advice: Advice;
  /** “mode 3 of A” */
  which: string;
  file: string;
}

/** Rank histograms of the chains: flat in every chain if the chains agree. */
export function RankPlots({ diagnostics, advice, which, file }: Props) {
  const { bins, chains } = diagnostics;
  const bars = chainsOf(diagnostics.ranks, chains);
  const band = rankBand(diagnostics);
  const shown = shownChains(chains, advice.chain);
  const size = Math.max(...shown.flatMap((chain) => bars[chain] ?? []), band.high);
  const limits = `${count(band.low)} to ${count(band.high)}`;
  return (
    <Chart
      name="ranks"
      title="Rank plots"
      about={`All draws of ${which} are ranked; each bar counts the draws of one chain in an interval of ranks. If the chains agree, most bars lie within the band, ${limits}.`}
      label={`Rank plots of ${which}: ${chains} chains with ${bins} bars each, from ${count(Math.min(...diagnostics.ranks))} to ${count(Math.max(...diagnostics.ranks))} draws high; ${count(band.expected)} are expected, chance allows ${limits}.`}
      height={(width) => gridOf(shown.length, width).height}
      draw={(width) => {
        const { columns, wide, tall } = gridOf(shown.length, width);
        return shown.map((chain, i) => (
          <Histogram
            key={chain}
            chain={chain}
            bars={bars[chain] ?? []}
            x={(i % columns) * (wide + GAP)}
            y={Math.floor(i / columns) * (tall + GAP)}
            wide={wide}
            tall={tall - NAME}
            band={band}
            size={size}
            named={chain === advice.chain}
          />
        ));
      }}
      advice={advice}
      table={() => (
        <DataTable
          file={file}
          caption={`Ranks of ${which}, number of draws`}
          corner="Ranks"
          columns={shown.map((chain) => ({ title: `Chain ${chain + 1}`, show: count }))}
          rows={Array.from({ length: bins }, (_, bin) => ({
            head: `${percentage(bin, bins)}–${percentage(bin + 1, bins)}\u202f%`,
            values: shown.map((chain) => bars[chain]?.[bin]),
          }))}
        />
      )}
    />
  );
}

const GAP = 14;
/** Height of a chain's name. */
const NAME = 16;

function gridOf(plots: number, width: number) {
  const columns = Math.max(1, Math.min(plots, Math.floor((width + GAP) / (110 + GAP)), 8));
  // As many plots in each row as fit, but no row with a single plot if that can be avoided.
  const even = Math.ceil(plots / Math.ceil(plots / columns));
  const wide = (width - GAP * (even - 1)) / even;
  const tall = plots <= 8 ? 96 : 70;
  const rows = Math.ceil(plots / even);
  return { columns: even, wide, tall, height: rows * tall + (rows - 1) * GAP + 2 };
}

function percentage(bin: number, bins: number): string {
  return String(Math.round((1000 * bin) / bins) / 10);
}

interface HistogramProps {
  chain: number;
  bars: number[];
  x: number;
  y: number;
  wide: number;
  tall: number;
  band: { expected: number; low: number; high: number };
  size: number;
  named: boolean;
}

function Histogram({ chain, bars, x, y, wide, tall, band, size, named }: HistogramProps) {
  const step = wide / bars.length;
  const at = (value: number) => NAME + tall * (1 - value / size);
  return (
    <g transform={`translate(${x} ${y})`} class="ranks" data-named={named}>
      <text class="tick" x={0} y={11}>
        chain {chain + 1}
      </text>
      <g class="chain" data-color={chain % 8}>
        {bars.map((value, bin) => (
          <rect
            key={bin}
            x={bin * step + 0.5}
            y={at(value)}
            width={Math.max(1, step - 1)}
            height={NAME + tall - at(value)}
            data-outside={value < band.low || value > band.high}
          />
        ))}
      </g>
      <rect
        class="band"
        x={0}
        y={at(band.high)}
        width={wide}
        height={at(band.low) - at(band.high)}
      />
      <line class="expected" x1={0} x2={wide} y1={at(band.expected)} y2={at(band.expected)} />
      <line class="grid" x1={0} x2={wide} y1={NAME + tall} y2={NAME + tall} />
    </g>
  );
}
