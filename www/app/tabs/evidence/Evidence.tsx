import type { EvidenceReport, Report } from "../../../worker/protocol";
import {
  HYPOTHESES,
  hypothesisSentence,
  noEvidence,
  QUESTIONS,
  verdict,
} from "../../comparison/evidence";
import { leftOutSentence, matchedSentence, pointsSentence } from "../../comparison/groups";
import { outOfDate, type Result, result, SIDES } from "../../state/state";
import { count } from "../../text/format";
import { Phrase } from "../../ui/Phrase";
import { BandCharts } from "./BandCharts";
import { Stability } from "./Stability";
import { Statistics } from "./Statistics";
import { ToldApart } from "./ToldApart";

/** The tab Evidence: whether the training shapes of the two models differ by more than chance, and by what. */
export function Evidence() {
  const found = result.value;
  return (
    <section class="tab evidence" aria-label="Evidence" data-stale={outOfDate.value}>
      {found ? (
        <OfResult found={found} />
      ) : (
        <p class="tab-empty">
          Whether the difference is more than chance is shown here once the pair is compared.
        </p>
      )}
    </section>
  );
}

function OfResult({ found: { report, cancelled } }: { found: Result }) {
  const { evidence } = report;
  if (evidence) return <OfShapes report={report} evidence={evidence} />;
  const { message, hint } = noEvidence(report, cancelled);
  return (
    <div class="verdict" data-answer="none">
      <h2>{message}</h2>
      <p>{hint}</p>
    </div>
  );
}

function OfShapes({ report, evidence }: { report: Report; evidence: EvidenceReport }) {
  const { unit } = report.models.a;
  const { differs, phrase, caution } = verdict(evidence);
  const matched = matchedSentence(evidence);
  return (
    <>
      <div class="verdict" data-answer={differs === null ? "none" : differs ? "differs" : "chance"}>
        <h2>
          <Phrase parts={phrase} />
        </h2>
        {caution && <p>{caution}</p>}
        <p>
          <Phrase parts={pointsSentence(evidence)} />
        </p>
        {matched && (
          <p>
            <Phrase parts={matched} />
          </p>
        )}
      </div>
      {evidence.conditions.map(({ code, message, hint }) => (
        <p key={code + message} class="warning" data-code={code}>
          {message} <span class="dim">{hint}</span>
        </p>
      ))}
      {HYPOTHESES.map((name) => (
        <section key={name} class="evidence-part" data-hypothesis={name}>
          <h3>{QUESTIONS[name].question}</h3>
          <p class="answer">
            <Phrase parts={hypothesisSentence(evidence, name)} />
          </p>
          <p class="small">{QUESTIONS[name].about}</p>
          <Statistics evidence={evidence} name={name} unit={unit} />
        </section>
      ))}
      <section class="evidence-part">
        <h3>Can single shapes be told apart?</h3>
        <p class="small">
          Each shape is left out of its own model, and compared with that and with the other model.{" "}
          <Phrase parts={leftOutSentence(evidence, unit)} />
        </p>
        <div class="charts">
          {SIDES.map((side) => (
            <ToldApart key={side} evidence={evidence} side={side} />
          ))}
        </div>
      </section>
      <section class="evidence-part">
        <h3>How many modes are stable?</h3>
        <p class="small">
          The shapes of a group are halved at random, again and again. Modes of the population are
          in both halves; modes that are accidents of who was measured are not.
        </p>
        <div class="charts">
          {SIDES.map((side) => (
            <Stability key={side} report={report} evidence={evidence} side={side} />
          ))}
        </div>
      </section>
      <section class="evidence-part">
        <h3>Curves of the groups, and their band of chance</h3>
        <p class="small">
          Of models of the two groups in one alignment, with{" "}
          {evidence.modes === 1 ? "1 mode" : `${count(evidence.modes)} modes`} each; the curves of
          the tab Measures are of the models as they are compared, and may differ. Grey: 5 to 95 %
          of the relabelled groups.
        </p>
        <div class="charts">
          <BandCharts evidence={evidence} unit={unit} />
        </div>
      </section>
    </>
  );
}
