import type { LessonStep } from "../../../../worker/protocol";
import { number, signed } from "../../../text/format";
import { isSaid } from "../../sampling/pacing";
import { stepVerdict } from "../../sampling/verdicts";

interface Props {
  step: LessonStep | undefined;
  /** Share of the animation of the step. */
  told: number;
  corrected: boolean;
}

/** Computation of the last step, line by line: log densities, Hastings factor, ratio, decision. */
export function Working({ step, told, corrected }: Props) {
  const compared = step !== undefined && isSaid("compare", told);
  const decided = step !== undefined && isSaid("decide", told);
  const at = <T,>(said: boolean, value: T | undefined) => (said ? value : undefined);
  return (
    <section class="step-working" aria-label="The last step in numbers">
      <dl class="step-sum">
        <Line
          label="log p(α′), of the proposal"
          metric="logDensityTo"
          value={at(compared, step?.logDensityTo)}
        />
        <Line
          label="− log p(α), of the state"
          metric="logDensityFrom"
          value={at(compared, step?.logDensityFrom)}
        />
        <Line
          label={corrected ? "+ log Hastings factor" : "+ log Hastings factor (left out)"}
          metric="logHastings"
          value={at(compared, step?.logHastings)}
        />
        <Line label="= log r" metric="logRatio" value={at(compared, step?.logRatio)} total />
      </dl>
      <RatioBar step={step} compared={compared} decided={decided} />
      <p class="step-verdict" data-accepted={decided ? step?.accepted : undefined}>
        {decided ? stepVerdict(step).text : compared ? "Draw u between 0 and 1 …" : "Propose …"}
      </p>
    </section>
  );
}

function Line({
  label,
  metric,
  value,
  total = false,
}: {
  label: string;
  metric: string;
  value: number | undefined;
  total?: boolean;
}) {
  return (
    <div class="step-line" data-total={total}>
      <dt>{label}</dt>
      <dd data-metric={`lastStep.${metric}`} data-value={value}>
        {value === undefined ? "…" : total ? signed(value) : number(value)}
      </dd>
    </div>
  );
}

/** Bar of the ratio r from 0 to 1, with u as a mark: accepted if u is below r. */
function RatioBar({
  step,
  compared,
  decided,
}: {
  step: LessonStep | undefined;
  compared: boolean;
  decided: boolean;
}) {
  const ratio = step ? Math.min(1, Math.exp(step.logRatio)) : 0;
  const label = !step
    ? "No step yet"
    : `r = ${number(Math.exp(step.logRatio))}, u = ${number(step.uniform)}: ${step.accepted ? "accepted" : "rejected"}`;
  return (
    <div class="ratio">
      <div class="ratio-bar" role="img" aria-label={label}>
        <span class="ratio-covered" style={{ width: `${compared ? 100 * ratio : 0}%` }} />
        <span
          class="ratio-needle"
          data-down={decided}
          style={{ left: `${100 * (step?.uniform ?? 0)}%` }}
        >
          <span class="ratio-flag" data-accepted={step?.accepted}>
            {decided ? (step?.accepted ? "✓" : "✕") : "u"}
          </span>
        </span>
      </div>
      <div class="ratio-scale" aria-hidden="true">
        <span>0</span>
        <span class="ratio-words">accepted if u is below r</span>
        <span>1</span>
      </div>
      <span
        class="unseen"
        data-metric="lastStep.uniform"
        data-value={decided ? step?.uniform : undefined}
      />
    </div>
  );
}
