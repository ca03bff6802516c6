import { number, percent, plusMinus } from "../../../text/format";
import { AdviceLine } from "../../../ui/Chart";
import { LessonNumber, LessonNumbers } from "../../parts/controls";
import { differenceVerdict } from "../../sampling/verdicts";
import type { DifferenceRun } from "./run";

interface NumbersProps {
  run: DifferenceRun;
  own: string;
  other: string;
  side: "a" | "b";
}

/** Numbers of the difference: its share, and the share of PCA's shapes that are not in it. */
export function Numbers({ run, own, other, side }: NumbersProps) {
  const found = run.found.value;
  const { probability = null, standardError = null } = found?.diagnostics ?? {};
  const { misled, misledDraws } = found?.principal ?? {};
  return (
    <>
      <p class="lesson-headline">
        <strong data-metric="figures.probability" data-value={probability ?? undefined}>
          {probability === null ? "–" : percent(probability)}
        </strong>{" "}
        <span
          class="dim"
          data-metric="figures.standardError"
          data-value={standardError ?? undefined}
        >
          ± {standardError === null ? "–" : plusMinus(0, 100 * standardError).spread}
        </span>{" "}
        of {own} cannot be made by {other}: E[1 − Lᴅ].
      </p>
      <LessonNumbers label="Shapes that PCA of the difference would make">
        <LessonNumber
          label={`shapes of the PCA that ${other} can make too`}
          metric="principal.misled"
          value={misled}
          show={percent}
        />
        <LessonNumber
          label="the same share of the draws"
          metric="principal.misledDraws"
          value={misledDraws}
          show={percent}
        />
      </LessonNumbers>
      {found && misled !== undefined && probability !== null && (
        <AdviceLine advice={{ ...differenceVerdict(side, probability, misled), chain: null }} />
      )}
      {found && (
        <p class="small">Recommended σ of this pair: {number(found.models.recommended)}.</p>
      )}
    </>
  );
}
