import type { ChainPlots, PairPlots, Report } from "../../../worker/protocol";
import {
  autocorrelationAdvice,
  distanceAdvice,
  pairsAdvice,
  rankAdvice,
  traceAdvice,
} from "../../comparison/advice";
import { type Coefficient, worstCoefficient } from "../../comparison/diagnosing";
import { belief, worstModes } from "../../comparison/words";
import { type Answer, useAnswer } from "../../state/asked";
import { engineClient } from "../../state/engine";
import {
  diagnosedMode,
  diagnosedSide,
  held,
  outOfDate,
  type Result,
  result,
  run,
} from "../../state/state";
import { number, plusMinus } from "../../text/format";
import { Phrase } from "../../ui/Phrase";
import { SweepChart } from "../regions/Sweep";
import { ChainLines } from "./ChainLines";
import { CoefficientChooser } from "./CoefficientChooser";
import { Correlation } from "./Correlation";
import { RankPlots } from "./RankPlots";
import { ScatterPlots } from "./ScatterPlots";

/** Modes in the triangle of pairs, and draws in each cell. */
const PAIRED_MODES = 5;
const PAIRED_DRAWS = 600;

/** Plots that show whether the draws have converged, each with a sentence of advice. */
export function Diagnostics() {
  const found = result.value;
  return (
    <section class="tab diagnostics" aria-label="Diagnostics" data-stale={outOfDate.value}>
      {found ? (
        <>
          <Verdict report={found.report} />
          <Plots found={found} />
          <SweepChart />
        </>
      ) : (
        <p class="tab-empty">Plots of the draws are shown here once the comparison is finished.</p>
      )}
    </section>
  );
}

function Verdict({ report }: { report: Report }) {
  const { converged, phrase } = belief(report);
  const worst = worstModes(report);
  return (
    <div class="verdict" data-converged={converged}>
      <h2>{converged ? "These draws have converged" : "Do not quote these numbers yet"}</h2>
      <p>
        <Phrase parts={phrase} />
      </p>
      {worst && (
        <p class="small">
          <Phrase parts={worst} />
        </p>
      )}
    </div>
  );
}

function Plots({ found }: { found: Result }) {
  const chosen = chosenCoefficient(found.report);
  // The engine must hold the comparison of the report.
  const asks = run.value === null && held.value?.key === found.key;
  const chains = useAnswer(asks ? { found, ...chosen } : null, (signal, { side, mode }) =>
    engineClient().diagnose(signal, side, mode),
  );
  const pairs = useAnswer(asks ? { found, side: chosen.side } : null, (signal, { side }) =>
    engineClient().pairs(signal, side, PAIRED_MODES, PAIRED_DRAWS),
  );
  return (
    <>
      <CoefficientChooser report={found.report} chosen={chosen} />
      {chains.shown ? (
        <div class="charts" data-stale={!chains.current} data-side={chains.shown.question.side}>
          <OfChains shown={chains.shown} />
        </div>
      ) : (
        <p class="tab-empty">Waiting for the draws…</p>
      )}
      {pairs.shown?.answer && (
        <div class="charts" data-stale={!pairs.current}>
          <OfPairs
            found={pairs.shown.question.found}
            side={pairs.shown.question.side}
            diagnostics={pairs.shown.answer}
          />
        </div>
      )}
    </>
  );
}

/** The chosen coefficient if these models have it, else the one with the worst diagnostics. */
function chosenCoefficient(report: Report): Coefficient {
  const worst = worstCoefficient(report, diagnosedSide.value);
  const side = diagnosedSide.value ?? worst.side;
  const mode = diagnosedMode.value;
  return mode === null || mode >= modesOf(report, side) ? worst : { side, mode };
}

function modesOf(report: Report, side: "a" | "b"): number {
  return report.intersection.coefficients?.[side].essBulk.length ?? report.models[side].modes;
}

type ChainAnswer = Answer<Coefficient & { found: Result }, ChainPlots>;

function OfChains({ shown }: { shown: ChainAnswer }) {
  const { question, answer: diagnostics, problem } = shown;
  if (!diagnostics) {
    return (
      <p class="tab-empty">
        {problem?.message} <span class="dim">{problem?.hint}</span>
      </p>
    );
  }
  const { side, mode, found } = question;
  const { report } = found;
  const { sampler, sigma } = report.settings;
  const { unit } = report.models.a;
  const name = side.toUpperCase();
  const which = `mode ${mode + 1} of ${name}`;
  const file = `${side}-mode-${mode + 1}`;
  const own = report.intersection.coefficients?.[side];
  const rHat = own?.rHat[mode] ?? null;
  const ess = own?.essBulk[mode] ?? report.intersection.sides[side].essBulkMin;
  const level = meanSd(diagnostics.distances);
  const each = diagnostics.every === 1 ? "" : ` Every ${ordinal(diagnostics.every)} draw is shown.`;
  return (
    <>
      <ChainLines
        name="trace"
        title={`Trace of ${which}`}
        about={`The coefficient of ${which} in every draw, in standard deviations of ${name}; one line for each chain.${each}`}
        label={`Trace of ${which}: ${diagnostics.chains} chains, ${diagnostics.length} draws of each shown${rHat === null ? "" : `, R-hat ${rHat.toFixed(4)}`}, ${number(ess, 3)} effective draws.`}
        diagnostics={diagnostics}
        values={diagnostics.draws}
        advice={traceAdvice(diagnostics, rHat, sampler)}
        upName={`coefficient, SD of ${name}`}
        file={`trace-${file}`}
        caption={`Draws of ${which}, in standard deviations`}
      />
      <RankPlots
        diagnostics={diagnostics}
        advice={rankAdvice(diagnostics, rHat, sampler)}
        which={which}
        file={`ranks-${file}`}
      />
      <Correlation
        diagnostics={diagnostics}
        advice={autocorrelationAdvice(diagnostics, ess, sampler)}
        which={which}
        file={`autocorrelation-${file}`}
      />
      <ChainLines
        name="distance"
        title={`Distance to the other model`}
        about={`Distance d of the same draws from the nearest shape of ${side === "a" ? "B" : "A"}, mean over the points, in ${unit}.${each}`}
        label={`Distance over draws of ${name}: ${level.mean} ± ${level.spread} ${unit}.`}
        diagnostics={diagnostics}
        values={diagnostics.distances}
        advice={distanceAdvice(diagnostics, unit, sampler)}
        upName={`d, ${unit}`}
        file={`distance-${side}`}
        caption={`Distance d of the draws from ${name}, ${unit}`}
        {...(sigma === null ? {} : { level: { value: sigma, label: "σ" } })}
      />
    </>
  );
}

function meanSd(values: Float32Array) {
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  const squares = values.reduce((sum, value) => sum + (value - mean) ** 2, 0);
  return plusMinus(mean, Math.sqrt(squares / Math.max(1, values.length - 1)));
}

function ordinal(value: number): string {
  const ending = { 1: "st", 2: "nd", 3: "rd" }[value % 10];
  const teens = value % 100 > 10 && value % 100 < 14;
  return `${value}${teens ? "th" : (ending ?? "th")}`;
}

interface PairProps {
  found: Result;
  side: "a" | "b";
  diagnostics: PairPlots;
}

function OfPairs({ found, side, diagnostics }: PairProps) {
  const own = found.report.intersection.coefficients?.[side].essBulk.slice(
    0,
    diagnostics.modes.length,
  );
  const ess = own ? Math.min(...own) : found.report.intersection.sides[side].essBulkMin;
  return (
    <ScatterPlots
      diagnostics={diagnostics}
      advice={pairsAdvice(diagnostics, ess)}
      model={side.toUpperCase()}
      file={`pairs-${side}`}
    />
  );
}
