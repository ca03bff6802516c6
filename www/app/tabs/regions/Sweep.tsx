import { signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { wasAborted } from "../../../worker/engine-errors";
import type { SweepPoint } from "../../../worker/protocol";
import { sweepAdvice } from "../../comparison/advice";
import { sweepPoint } from "../../comparison/run";
import { canPreview, held, recommended, result, settings, tab, unit } from "../../state/state";
import { length } from "../../text/format";
import { sweepSigmas } from "../../text/plots";
import { Chart } from "../../ui/Chart";
import { ShowNumbers } from "../../ui/ShowNumbers";
import { SweepLegend, SweepLines, SweepTable } from "./SweepPlot";

const [WIDTH, HEIGHT] = [320, 190];

/** The computed sweep and the comparison that it belongs to, kept to be shown again. */
const swept = signal<{ base: string | null; points: SweepPoint[]; done: boolean }>({
  base: null,
  points: [],
  done: false,
});

/** Computes how A∩B depends on σ, by the Gaussian fit alone, one σ after the other, while the plot is open. */
function useSweep(open: boolean) {
  const base = held.value?.base ?? null;
  const middle = recommended.value ?? result.value?.report.settings.sigma ?? null;
  const ready = open && canPreview.value && middle !== null;
  useEffect(() => {
    if (!ready || (swept.peek().base === base && swept.peek().done)) return;
    const controller = new AbortController();
    void (async () => {
      swept.value = { base, points: [], done: false };
      for (const sigma of sweepSigmas(middle)) {
        const point = await sweepPoint(controller.signal, sigma);
        const points = [...swept.peek().points, ...(point ? [point] : [])];
        swept.value = { base, points, done: false };
      }
      swept.value = { ...swept.peek(), done: true };
    })().catch((thrown: unknown) => {
      // The engine reports the error; the sweep starts again with the next comparison.
      if (!wasAborted(thrown)) swept.value = { ...swept.peek(), base: null };
    });
    return () => controller.abort();
  }, [ready, base, middle]);
  const { points, done } = swept.value;
  return { points, done, current: swept.value.base === base };
}

function waiting(done: boolean): string {
  if (done) return "The Gaussian fit fails at every σ.";
  return canPreview.value ? "Computing other σ…" : "Shown once the comparison is finished.";
}

/** The σ sweep among the results; the tab Diagnostics has it among its plots instead. */
export function Sweep() {
  const open = useSignal(false);
  const elsewhere = tab.value === "diagnostics";
  const { points, done, current } = useSweep(open.value && !elsewhere);
  if (elsewhere) return null;
  return (
    <details
      class="more sweep"
      onToggle={(event) => {
        open.value = event.currentTarget.open;
      }}
    >
      <summary>How the intersection depends on σ</summary>
      {open.value && current && points.length > 1 ? (
        <figure class="sweep-figure" data-done={done} data-points={points.length}>
          <svg viewBox={`0 0 ${WIDTH} ${HEIGHT}`} class="plot" aria-hidden="true">
            <SweepLines points={points} width={WIDTH} height={HEIGHT} />
          </svg>
          <SweepLegend />
          <ShowNumbers>{() => <SweepTable points={points} />}</ShowNumbers>
        </figure>
      ) : (
        <p class="small">{waiting(done && current)}</p>
      )}
    </details>
  );
}

/** The σ sweep in the tab Diagnostics, with advice on the σ in use. */
export function SweepChart() {
  const { points, done, current } = useSweep(true);
  const used = settings.value.sigma ?? recommended.value;
  if (points.length < 2) {
    return (
      <section class="chart">
        <h3>How A∩B depends on σ</h3>
        <p class="small">{waiting(done)}</p>
      </section>
    );
  }
  const [first, last] = [points[0], points.at(-1)];
  return (
    <div data-done={done} data-stale={!current}>
      <Chart
        name="sweep"
        title="How A∩B depends on σ"
        about="A∩B at other tolerances σ as the Gaussian fit alone predicts it, without draws."
        label={
          first && last
            ? `At σ ${length(first.sigma, unit.value)} A∩B varies by ${length(first.vertexSd, unit.value)} per vertex, at σ ${length(last.sigma, unit.value)} by ${length(last.vertexSd, unit.value)}.`
            : ""
        }
        height={() => 236}
        draw={(width) => <SweepLines points={points} width={width} height={236} />}
        legend={<SweepLegend />}
        advice={done && used !== null ? sweepAdvice(points, used) : null}
        table={() => <SweepTable points={points} />}
      />
    </div>
  );
}
