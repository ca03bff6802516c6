import type { ModeDiagnostics, Report, Sides } from "../../../worker/protocol";
import { ESS, inferred, R_HAT, worstModes } from "../../comparison/words";
import { count, number } from "../../text/format";
import { linear, logarithmic, type Scale } from "../../text/plots";
import { Mark } from "../../ui/Mark";
import { Metric, Phrase } from "../../ui/Phrase";
import { SaveTable } from "../../ui/SaveTable";
import { ShowNumbers } from "../../ui/ShowNumbers";

const SIDES = ["a", "b"] as const;

/** Which sampler ran for each model, and why. */
export function Inferred({ report }: { report: Report }) {
  const [a, b] = [inferred(report, "a"), inferred(report, "b")];
  if (a === null || b === null) return null;
  if (a === b) {
    return (
      <p class="inferred" data-side="both">
        <strong>From A and from B.</strong> {a}
      </p>
    );
  }
  return (
    <>
      <p class="inferred" data-side="a">
        <strong>From A.</strong> {a}
      </p>
      <p class="inferred" data-side="b">
        <strong>From B.</strong> {b}
      </p>
    </>
  );
}

type Statistic = "rHat" | "essBulk" | "essTail";
const PLOTS: { statistic: Statistic; title: string; limit: number }[] = [
  { statistic: "rHat", title: "R-hat", limit: R_HAT },
  { statistic: "essBulk", title: "Bulk ESS", limit: ESS },
  { statistic: "essTail", title: "Tail ESS", limit: ESS },
];

/** Plots of R-hat and effective sample sizes of every mode of both models, with their limits. */
export function ModePlots({ report }: { report: Report }) {
  const both = report.intersection.coefficients;
  const worst = worstModes(report);
  if (!both || !worst) return null;
  return (
    <figure class="mode-figures">
      <figcaption>Every mode: circles for A, squares for B, the limit dashed</figcaption>
      {PLOTS.map(({ statistic, title, limit }) =>
        both.a[statistic].length + both.b[statistic].length === 0 ? null : (
          <ModePlot key={statistic} both={both} statistic={statistic} title={title} limit={limit} />
        ),
      )}
      <p class="small">
        <Phrase parts={worst} />
      </p>
      <ShowNumbers label="Show every mode’s numbers">{() => <ModeTable both={both} />}</ShowNumbers>
    </figure>
  );
}

const [WIDTH, HEIGHT] = [320, 72];
const BOX = { left: 34, right: 8, top: 20, bottom: 6 };

interface PlotProps {
  both: Sides<ModeDiagnostics>;
  statistic: Statistic;
  title: string;
  limit: number;
}

function ModePlot({ both, statistic, title, limit }: PlotProps) {
  const values = SIDES.flatMap((side) => both[side][statistic]).filter(Number.isFinite);
  const modes = Math.max(both.a[statistic].length, both.b[statistic].length);
  const [low, high] = [Math.min(limit, ...values), Math.max(limit, ...values)];
  const [bottom, top] = [HEIGHT - BOX.bottom, BOX.top];
  const y: Scale =
    statistic === "rHat"
      ? linear(Math.min(1, low), high, bottom, top)
      : logarithmic(Math.max(1, low / 1.5), high * 1.2, bottom, top);
  const x = linear(1, Math.max(2, modes), BOX.left + 6, WIDTH - BOX.right);
  const fails = (value: number) => (statistic === "rHat" ? value >= limit : value < limit);
  return (
    <svg viewBox={`0 0 ${WIDTH} ${HEIGHT}`} class="plot mode-plot" aria-hidden="true">
      <text class="tick" x={BOX.left} y={10}>
        {title}
      </text>
      <line class="limit" x1={BOX.left} x2={WIDTH - BOX.right} y1={y(limit)} y2={y(limit)} />
      <text class="tick" x={BOX.left - 4} y={y(limit) + 3} text-anchor="end">
        {limit}
      </text>
      {SIDES.map((side) => (
        <g key={side} class="mode-marks" data-side={side}>
          {both[side][statistic].map((value, i) =>
            Number.isFinite(value) ? (
              <g key={i} data-fails={fails(value)}>
                <title>
                  Mode {i + 1} of {side.toUpperCase()}: {number(value, 5)}
                </title>
                <Mark
                  kind={side === "a" ? "circle" : "square"}
                  x={x(i + 1) + (side === "a" ? -1 : 1)}
                  y={y(Math.max(value, statistic === "rHat" ? 1 : value))}
                />
              </g>
            ) : null,
          )}
        </g>
      ))}
    </svg>
  );
}

const COLUMNS: { name: keyof ModeDiagnostics; title: string; show: (value: number) => string }[] = [
  { name: "rHat", title: "R-hat", show: (value) => value.toFixed(4) },
  { name: "essBulk", title: "bulk ESS", show: count },
  { name: "essTail", title: "tail ESS", show: count },
  { name: "mcseMean", title: "MCSE mean", show: (value) => number(value, 2) },
  { name: "mcseSd", title: "MCSE SD", show: (value) => number(value, 2) },
  { name: "autocorrelation", title: "lag 1", show: (value) => value.toFixed(2).replace("-", "−") },
];

function ModeTable({ both }: { both: Sides<ModeDiagnostics> }) {
  return (
    <SaveTable file="coefficients" of="every mode’s numbers">
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls must be reached by keys */}
      <section class="scrolled" tabIndex={0} aria-label="Diagnostics of every mode">
        <table class="numbers" data-columns="6">
          <caption>In standard deviations of each mode</caption>
          <thead>
            <tr>
              <th scope="col">Mode</th>
              {COLUMNS.map(({ name, title }) => (
                <th key={name} scope="col">
                  {title}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {SIDES.flatMap((side) =>
              both[side].essBulk.map((_, i) => (
                <tr key={`${side}${i}`}>
                  <th scope="row">
                    {side.toUpperCase()}&nbsp;{i + 1}
                  </th>
                  {COLUMNS.map(({ name, show }) => {
                    const value = both[side][name]?.[i];
                    const path = `intersection.coefficients.${side}.${name}.${i}`;
                    return (
                      <td key={name}>
                        {value == null ? (
                          <span class="dim">–</span>
                        ) : (
                          <Metric path={path} value={value} text={show(value)} />
                        )}
                      </td>
                    );
                  })}
                </tr>
              )),
            )}
          </tbody>
        </table>
      </section>
    </SaveTable>
  );
}
