import type { ComponentChildren } from "preact";
import { useMemo } from "preact/hooks";
import type { EvidenceReport, Side } from "../../../worker/protocol";
import { CHANCE, chanceTopic, said } from "../../comparison/answer";
import { caution, HYPOTHESES, hypothesisSentence, QUESTIONS } from "../../comparison/evidence";
import { leftOutSentence, matchedSentence, pointsSentence } from "../../comparison/groups";
import { outOfDate, type Result, result, SIDES } from "../../state/state";
import { count } from "../../text/format";
import { InTurn } from "../../ui/InTurn";
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

function OfResult({ found }: { found: Result }) {
  const { evidence } = found.report;
  return evidence ? <OfShapes found={found} evidence={evidence} /> : <Answer found={found} />;
}

/** The sentence of the report about chance, with what there is to add. */
function Answer({
  found: { report, nouns },
  children,
}: {
  found: Result;
  children?: ComponentChildren;
}) {
  const chance = said(report, nouns, ...CHANCE);
  return (
    <div class="verdict" data-answer={chanceTopic(report) ?? "none"}>
      <h2>
        {chance ? <Phrase parts={chance} /> : "Whether this is more than chance is not known."}
      </h2>
      {children}
    </div>
  );
}

function OfShapes({ found, evidence }: { found: Result; evidence: EvidenceReport }) {
  const parts = useMemo(() => partsOf(found, evidence), [found, evidence]);
  return <InTurn parts={parts} />;
}

function partsOf(found: Result, evidence: EvidenceReport): ComponentChildren[] {
  const { report } = found;
  const { unit } = report.models.a;
  const tells = (side: Side) => said(report, found.nouns, `told-apart-${side}`) !== null;
  const careful = caution(evidence);
  const matched = matchedSentence(evidence);
  return [
    <Answer key="answer" found={found}>
      {careful && <p>{careful}</p>}
      <p>
        <Phrase parts={pointsSentence(evidence)} />
      </p>
      {matched && (
        <p>
          <Phrase parts={matched} />
        </p>
      )}
    </Answer>,
    evidence.conditions.map(({ code, message, hint }) => (
      <p key={code + message} class="warning" data-code={code}>
        {message} <span class="dim">{hint}</span>
      </p>
    )),
    ...HYPOTHESES.map((name) => (
      <section key={name} class="evidence-part" data-hypothesis={name}>
        <h3>{QUESTIONS[name].question}</h3>
        <p class="answer">
          <Phrase parts={hypothesisSentence(evidence, name)} />
        </p>
        <p class="small">{QUESTIONS[name].about}</p>
        <Statistics evidence={evidence} name={name} unit={unit} />
      </section>
    )),
    <section key="told-apart" class="evidence-part">
      <h3>Can single shapes be told apart?</h3>
      <p class="small">
        Each shape is left out of its own model, and compared with that and with the other model.{" "}
        <Phrase parts={leftOutSentence(evidence, unit)} />
      </p>
      {SIDES.some((side) => tells(side)) ? (
        <div class="charts">
          {SIDES.map((side) => (
            <ToldApart key={side} evidence={evidence} side={side} />
          ))}
        </div>
      ) : (
        <p class="answer">
          Cannot be said: what the models miss of shapes that they have not seen is not known, or
          the shapes of each group fill the space of all of them.
        </p>
      )}
    </section>,
    <section key="stability" class="evidence-part">
      <h3>How many modes are stable?</h3>
      <p class="small">
        The shapes of a group are halved at random, again and again. Modes of the population are in
        both halves; modes that are accidents of who was measured are not.
      </p>
      <div class="charts">
        {SIDES.map((side) => (
          <Stability key={side} report={report} evidence={evidence} side={side} />
        ))}
      </div>
    </section>,
    <section key="bands" class="evidence-part">
      <h3>Curves of the groups, and their band of chance</h3>
      <p class="small">
        Of models of the two groups in one alignment, with{" "}
        {evidence.modes === 1 ? "1 mode" : `${count(evidence.modes)} modes`} each; the curves of the
        tab Measures are of the models as they are compared, and may differ. Grey: 5 to 95 % of the
        relabelled groups.
      </p>
      <div class="charts">
        <BandCharts evidence={evidence} unit={unit} />
      </div>
    </section>,
  ];
}
