import type { Report } from "../../../worker/protocol";
import { CHANCE, chanceTopic, said } from "../../comparison/answer";
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
  variances,
} from "../../comparison/words";
import { linked, opening, outOfDate, result, run, SIDES, slots } from "../../state/state";
import { count, degrees } from "../../text/format";
import { Metric, Phrase } from "../../ui/Phrase";
import { Inferred, ModePlots } from "./Inference";
import { Modes } from "./Modes";
import { Numbers } from "./Numbers";
import { Sweep } from "./Sweep";
import { TwoSides } from "./TwoSides";

/** The answer, whatever σ: how far either model lies from the other, and whether that is more than chance. */
export function Headline() {
  const held = result.value;
  const stale = outOfDate.value;
  if (!held) return <h2 class="headline">{waiting()}</h2>;
  const { report, nouns } = held;
  const other = said(report, nouns, "reach-of-b");
  const chance = said(report, nouns, ...CHANCE);
  return (
    <div class="answer-first" data-stale={stale}>
      <h2 class="headline" data-stale={stale}>
        <Phrase parts={headline(report, nouns)} />
      </h2>
      {other && (
        <p class="headline-other">
          <Phrase parts={other} />
        </p>
      )}
      <p class="chance" data-answer={chanceTopic(report) ?? "pending"}>
        {chance ? <Phrase parts={chance} /> : pending(report)}
      </p>
    </div>
  );
}

/** While shapes are relabelled, and for reports of engines that did not. */
function pending(report: Report): string {
  return run.value && report.answer ? "Whether this is more than chance is being computed." : "";
}

function waiting(): string {
  const open = SIDES.filter((side) => slots[side].value || opening[side].value);
  return linked.value?.urls && open.length < 2
    ? "Waiting for the models of the link."
    : "Comparing two shape models.";
}

const TOLD_APART = ["told-apart-a", "told-apart-b"] as const;

/** Sentences, warnings and tables of the comparison. */
export function Results() {
  const held = result.value;
  if (!held) return null;
  const { report, nouns } = held;
  const { converged, phrase } = belief(report);
  return (
    <section class="results" aria-label="Results" data-stale={outOfDate.value}>
      <ul class="says">
        {TOLD_APART.map((topic) => {
          const sentence = said(report, nouns, topic);
          return (
            sentence && (
              <li key={topic} data-about={topic}>
                <Phrase parts={sentence} />
              </li>
            )
          );
        })}
        <li data-about="intersection">
          <Phrase parts={shared(report)} />
        </li>
        <li data-about="differences">
          <Phrase parts={differences(report, nouns)} />
        </li>
        <li data-about="spaces">
          <Phrase parts={spaces(report)} />{" "}
          {report.answer && <Phrase parts={variances(report, nouns)} />}
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
