import type { ComponentChildren } from "preact";
import type { ChainPlots } from "../../../worker/protocol";
import { chainsOf, shownChains } from "../../comparison/diagnosing";
import { count } from "../../text/format";
import { linear, ticks } from "../../text/plots";
import type { Advice } from "../../ui/Chart";
import { Chart } from "../../ui/Chart";
import { DataTable } from "../../ui/DataTable";
import { PlotAxes } from "../../ui/PlotAxes";

interface Props {
  name: string;
  title: string;
  about: ComponentChildren;
  label: string;
  diagnostics: ChainPlots;
  /** Values of all chains, one chain after the other. */
  values: ArrayLike<number>;
  advice: Advice;
  upName: string;
  /** Name of the CSV file, and caption of its table. */
  file: string;
  caption: string;
  /** A level that is marked by a line, if it is within the range of the values. */
  level?: { value: number; label: string };
}

/** Line plot of every chain over its draws; the chain that the advice names is drawn stronger. */
export function ChainLines(props: Props) {
  const { name, title, about, label, diagnostics, values, advice, file, caption } = props;
  const chains = chainsOf(values, diagnostics.chains);
  const shown = shownChains(diagnostics.chains, advice.chain);
  return (
    <Chart
      name={name}
      title={title}
      about={
        <>
          {about}
          {shown.length < chains.length &&
            ` ${shown.length} of ${count(chains.length)} chains are drawn.`}
        </>
      }
      label={label}
      height={() => 216}
      draw={(width) => <Lines {...props} chains={chains} shown={shown} width={width} />}
      legend={<ChainLegend shown={shown} named={advice.chain} />}
      advice={advice}
      table={() => (
        <DataTable
          file={file}
          caption={caption}
          corner="Draw"
          columns={shown.map((chain) => ({ title: `Chain ${chain + 1}` }))}
          rows={Array.from({ length: diagnostics.length }, (_, i) => ({
            head: i * diagnostics.every + 1,
            values: shown.map((chain) => chains[chain]?.[i]),
          }))}
        />
      )}
    />
  );
}

interface LinesProps extends Props {
  chains: number[][];
  shown: number[];
  width: number;
}

function Lines({ chains, shown, width, diagnostics, advice, upName, level }: LinesProps) {
  const box = { left: 46, right: width - 8, top: 24, bottom: 180 };
  const drawn = shown.flatMap((chain) => chains[chain] ?? []).filter(Number.isFinite);
  const [low, high] = extent(drawn);
  const last = (diagnostics.length - 1) * diagnostics.every + 1;
  const x = linear(1, Math.max(2, last), box.left, box.right);
  const y = linear(low, high, box.bottom, box.top);
  const within = (value: number) => value >= low && value <= high;
  return (
    <>
      <PlotAxes
        box={box}
        x={x}
        y={y}
        across={[1, ...ticks(0, last, 4).filter((value) => value > 1 && value <= last)]}
        up={ticks(low, high, 4).filter(within)}
        acrossName="draw of the chain"
        upName={upName}
        showAcross={count}
      />
      {level && within(level.value) && (
        <g class="level">
          <line x1={box.left} x2={box.right} y1={y(level.value)} y2={y(level.value)} />
          <text class="tick" x={box.right - 3} y={y(level.value) - 4} text-anchor="end">
            {level.label}
          </text>
        </g>
      )}
      <g class="chains" data-named={advice.chain !== null}>
        {shown.map((chain) => (
          <polyline
            key={chain}
            class="chain"
            data-color={chain % 8}
            data-named={chain === advice.chain}
            points={(chains[chain] ?? [])
              .map(
                (value, i) => `${x(i * diagnostics.every + 1).toFixed(1)},${y(value).toFixed(1)}`,
              )
              .join(" ")}
          />
        ))}
      </g>
    </>
  );
}

function extent(values: number[]): [number, number] {
  const low = values.reduce((least, value) => Math.min(least, value), Number.POSITIVE_INFINITY);
  const high = values.reduce((most, value) => Math.max(most, value), Number.NEGATIVE_INFINITY);
  const margin = 0.04 * (high - low) || 1;
  return [low - margin, high + margin];
}

/** Number of chains above which there is no legend: the colours repeat. */
const MOST_NAMES = 16;

export function ChainLegend({ shown, named }: { shown: number[]; named: number | null }) {
  if (shown.length > MOST_NAMES) return null;
  return (
    <ul class="legend chain-legend" aria-hidden="true">
      {shown.map((chain) => (
        <li key={chain} data-named={chain === named}>
          <svg viewBox="0 0 18 10" aria-hidden="true">
            <line class="chain" data-color={chain % 8} x1={0} x2={18} y1={5} y2={5} />
          </svg>
          chain {chain + 1}
        </li>
      ))}
    </ul>
  );
}
