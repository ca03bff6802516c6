import { DIAGNOSTICS, GROUPS } from "../../comparison/numbers";
import {
  belief,
  differences,
  ESS,
  furtherWarnings,
  headline,
  R_HAT,
  shared,
  spaces,
} from "../../comparison/words";
import { linked, opening, outOfDate, result, SIDES, slots } from "../../state/state";
import { count, degrees } from "../../text/format";
import { Metric, Phrase } from "../../ui/Phrase";
import { Inferred, ModePlots } from "./Inference";
import { Modes } from "./Modes";
import { Numbers } from "./Numbers";
import { Sweep } from "./Sweep";
import { TwoSides } from "./TwoSides";

/** The first sentence of the results: how much of the variance each model can make of the other. */
export function Headline() {
  const held = result.value;
  return (
    <h2 class="headline" data-stale={outOfDate.value}>
      {held ? <Phrase parts={headline(held.report, held.nouns)} /> : waiting()}
    </h2>
  );
}

function waiting(): string {
  const open = SIDES.filter((side) => slots[side].value || opening[side].value);
  return linked.value?.urls && open.length < 2
    ? "Waiting for the models of the link."
    : "Comparing two shape models.";
}

/** Sentences, warnings and tables of the comparison. */
export function Results() {
  const held = result.value;
  if (!held) return null;
  const { report, nouns } = held;
  const { converged, phrase } = belief(report);
  return (
    <section class="results" aria-label="Results" data-stale={outOfDate.value}>
      <ul class="says">
        <li data-about="intersection">
          <Phrase parts={shared(report)} />
        </li>
        <li data-about="differences">
          <Phrase parts={differences(report, nouns)} />
        </li>
        <li data-about="spaces">
          <Phrase parts={spaces(report)} />
        </li>
        <li data-about="belief" data-converged={converged}>
          <Phrase parts={phrase} />
        </li>
      </ul>
      {furtherWarnings(report).map(({ code, message, hint }) => (
        <p key={code} class="warning" data-code={code}>
          {message} <span class="dim">{hint}</span>
        </p>
      ))}
      {GROUPS.map((group) => (
        <Numbers key={group.title} group={group} report={report} />
      ))}
      <Sweep />
      <Modes report={report} />
      <TwoSides report={report} />
      <details class="more believed">
        <summary>Have the draws converged?</summary>
        <Inferred report={report} />
        <Numbers group={DIAGNOSTICS} report={report} />
        <p class="small">
          R-hat (rank-normalised, split and folded) should be below {R_HAT} and ESS above{" "}
          {count(ESS)} for every mode; or Pareto k below 0.7 and the effective size of the weights
          above {count(1000)}. MCSE is the Monte-Carlo standard error, in standard deviations of a
          mode. A difference is sampled exactly, so its draws are independent and have no R-hat.
        </p>
        <ModePlots report={report} />
        <Angles angles={report.overlap.principalAnglesDegrees} />
      </details>
    </section>
  );
}

function Angles({ angles }: { angles: number[] }) {
  if (angles.length === 0) return null;
  return (
    <div class="angles">
      <h3>Principal angles between the two spaces</h3>
      <ol>
        {angles.map((angle, i) => {
          const path = `overlap.principalAnglesDegrees.${i}`;
          return (
            <li key={path}>
              <Metric path={path} value={angle} text={degrees(angle)} />
            </li>
          );
        })}
      </ol>
    </div>
  );
}
