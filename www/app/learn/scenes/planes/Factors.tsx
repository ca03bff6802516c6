import type { ComponentChildren } from "preact";
import type { LessonPoint, Side } from "../../../../worker/protocol";
import { letters } from "../../../state/regions";
import { number } from "../../../text/format";

interface Props {
  point: LessonPoint | null;
  side: Side;
}

/** The factors of the density of A∩B at the point, as bars from 0 to 1: nearness, plausibility in both models. */
export function Factors({ point, side }: Props) {
  const [here, there] = letters(side);
  return (
    <dl class="factors" aria-label="Factors of the density of A∩B at x">
      <Factor
        name="near"
        formula={
          <>
            L<sub>D</sub> = exp(−½(d/σ)²)
          </>
        }
        share={point?.distanceLikelihood}
        metric="point.distanceLikelihood"
        value={point?.distanceLikelihood}
      />
      <Factor
        name={`× plausible in ${there}`}
        formula={
          <>
            L<sub>P</sub> = exp(−½‖α′‖²)
          </>
        }
        share={point?.projectionLikelihood}
        metric="point.projectionLikelihood"
        value={point?.projectionLikelihood}
      />
      <Factor
        name={`× plausible in ${here}`}
        formula="log p(α) = −½‖α‖²"
        share={point && Math.exp(point.logPrior)}
        metric="point.logPrior"
        value={point?.logPrior}
      />
      <Factor
        name="= common to both"
        formula="log p(α | A∩B) + const"
        share={point && Math.exp(point.logDensity)}
        metric="point.logDensity"
        value={point?.logDensity}
        whole
      />
    </dl>
  );
}

interface FactorProps {
  name: string;
  formula: ComponentChildren;
  share: number | null | undefined;
  metric: string;
  value: number | null | undefined;
  whole?: boolean;
}

function Factor({ name, formula, share, metric, value, whole = false }: FactorProps) {
  return (
    <div class="factor" data-whole={whole}>
      <dt>
        {name} <span class="small">{formula}</span>
      </dt>
      <dd class="factor-bar" aria-hidden="true">
        <span style={{ width: `${100 * (share ?? 0)}%` }} />
      </dd>
      <dd class="num" data-metric={metric} data-value={value ?? undefined}>
        {value == null ? "–" : number(value)}
      </dd>
    </div>
  );
}
