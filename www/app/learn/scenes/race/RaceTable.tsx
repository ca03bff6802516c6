import type { ChainGroupSummary } from "../../../../worker/protocol";
import { number, percent } from "../../../text/format";
import { logShare, logTicks } from "../../sampling/axes";
import { SAMPLER_NAMES } from "../../sampling/names";
import { R_HAT_LIMIT } from "../../sampling/verdicts";
import type { Runner } from "./run";

/** Range of the effective draws per 1,000 evaluations; 1,000 are independent draws. */
const [LOW, HIGH] = [0.1, 1000];
/** Share of the width from which on a bar has its number inside. */
const INSIDE = 0.62;

interface Props {
  runners: readonly Runner[];
  diagnostics: readonly ChainGroupSummary[];
}

/** Table of effective draws per 1,000 evaluations, R-hat and acceptance of each sampler. */
export function RaceTable({ runners, diagnostics }: Props) {
  return (
    <table class="race-table">
      <caption>
        Effective draws per 1,000 evaluations of the density (a gradient counts as one more),
        logarithmic
      </caption>
      <thead>
        <tr>
          <th scope="col">Sampler</th>
          <th scope="col" class="race-scale">
            <span class="unseen">Effective draws per 1,000 evaluations</span>
            <span class="race-ticks" aria-hidden="true">
              {logTicks(LOW, HIGH).map((value) => (
                <span key={value} style={{ left: `${100 * logShare(value, LOW, HIGH)}%` }}>
                  {number(value, 1)}
                </span>
              ))}
            </span>
          </th>
          <th scope="col">R-hat</th>
          <th scope="col">accepted</th>
        </tr>
      </thead>
      <tbody>
        {runners.map(({ sampler }, i) => (
          <Row key={sampler} name={SAMPLER_NAMES[sampler]} diagnostics={diagnostics[i]} index={i} />
        ))}
      </tbody>
    </table>
  );
}

function Row({
  name,
  diagnostics,
  index,
}: {
  name: string;
  diagnostics: ChainGroupSummary | undefined;
  index: number;
}) {
  const { essPerThousand = null, rHatMax = null, acceptance = null } = diagnostics ?? {};
  const path = `race.${index}.figures`;
  const share = essPerThousand === null ? 0 : logShare(essPerThousand, LOW, HIGH);
  return (
    <tr>
      <th scope="row">{name}</th>
      <td class="race-bar">
        <span class="race-fill" style={{ width: `${100 * share}%` }} />
        <span
          class="race-value"
          data-inside={share > INSIDE}
          style={{ left: `${100 * share}%` }}
          data-metric={`${path}.essPerThousand`}
          data-value={essPerThousand ?? undefined}
        >
          {essPerThousand === null ? "–" : number(essPerThousand, 2)}
        </span>
      </td>
      <td
        data-metric={`${path}.rHatMax`}
        data-value={rHatMax ?? undefined}
        data-good={rHatMax !== null && rHatMax < R_HAT_LIMIT}
      >
        {rHatMax === null ? "–" : number(rHatMax, 4)}
      </td>
      <td data-metric={`${path}.acceptance`} data-value={acceptance ?? undefined}>
        {acceptance === null ? "–" : percent(acceptance)}
      </td>
    </tr>
  );
}
