import type { Report } from "../../../worker/protocol";
import { hasSplitting, SPLITTING, SPLITTING_SENTENCES } from "../../comparison/measured";
import { useAnswer } from "../../state/asked";
import { engineClient } from "../../state/engine";
import { held, outOfDate, type Result, result, run, settings, slots } from "../../state/state";
import { Numbers } from "../regions/Numbers";
import { Angles } from "./Angles";
import { Divergences, GrassmannDistances } from "./Apart";
import { Evaluations } from "./Evaluations";
import { Compactness, ExclusiveSpectrum } from "./Spectra";
import { VarianceBars } from "./VarianceBars";

/** The tab Measures: shared variance, angles, distances, spectra and quality of the two models. */
export function Measures() {
  const found = result.value;
  return (
    <section class="tab measures" aria-label="Measures">
      {found ? (
        <OfPair found={found} />
      ) : (
        <p class="tab-empty">The measures of the pair are shown here once it is compared.</p>
      )}
      <Evaluations />
    </section>
  );
}

function OfPair({ found }: { found: Result }) {
  const { report, nouns } = found;
  const [a, b] = [slots.a.value?.model, slots.b.value?.model];
  // The relation in the table must be of the same pair as the report.
  const asks =
    run.value === null && !outOfDate.value && held.value?.key === found.key && a !== undefined;
  const relation = useAnswer(asks && b !== undefined ? { found, a, b } : null, (signal, pair) =>
    engineClient().relate(signal, pair.a, pair.b, settings.peek()),
  );
  const related = relation.shown?.question.found === found ? relation.shown.answer : null;
  return (
    <div class="charts" data-stale={outOfDate.value}>
      <VarianceBars report={report} nouns={nouns} />
      <Angles report={report} />
      <GrassmannDistances report={report} relation={related} />
      <Divergences report={report} />
      <Compactness report={report} />
      <ExclusiveSpectrum report={report} />
      <Splitting report={report} />
    </div>
  );
}

/** Compares the set difference with Hall's linear splitting, a baseline from moments only. */
function Splitting({ report }: { report: Report }) {
  if (!hasSplitting(report)) return null;
  return (
    <section class="chart" data-chart="splitting">
      <h3>Linear splitting, a baseline</h3>
      <p class="small">{SPLITTING_SENTENCES}</p>
      <Numbers group={SPLITTING} report={report} />
    </section>
  );
}
