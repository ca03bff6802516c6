import { useMemo } from "preact/hooks";
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

/** How often shapes that were left out of a group are nearer to it. */
const TOLD_APART = ["told-apart-a", "told-apart-b"] as const;

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
        {TOLD_APART.map((topic) => {
          const sentence = said(report, nouns, topic);
          return (
            sentence && (
              <span key={topic} data-about={topic}>
                {" "}
                <Phrase parts={sentence} />
              </span>
            )
          );
        })}
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

/** Sentences, warnings and tables of the comparison. */
export function Results() {
  const held = result.value;
  // Evidence, which comes later than the rest of a report, changes none of them.
  const tables = useMemo(
    () => held && <Tables report={held.report} />,
    [held?.report.intersection, held?.report.reach],
  );
  if (!held) return null;
  const { report, nouns } = held;
  const { converged, phrase } = belief(report);
  const plausible = said(report, nouns, "nearest-plausible");
  return (
    <section class="results" aria-label="Results" data-stale={outOfDate.value}>
      <ul class="says">
        {plausible && (
          <li data-about="nearest-plausible">
            <Phrase parts={plausible} />
          </li>
        )}
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
      {tables}
    </section>
  );
}

/** The tables of a report, and how far the draws can be believed. */
function Tables({ report }: { report: Report }) {
  return (
    <>
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
    </>
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
