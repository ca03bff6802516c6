import { number } from "../../../text/format";
import { AdviceLine } from "../../../ui/Chart";
import { LessonNumber, LessonNumbers } from "../../parts/controls";
import { cloudVerdict } from "../../sampling/verdicts";
import type { CloudRun } from "./run";

/** Numbers of the model of the draws: its error, and the convergence of the draws. */
export function Numbers({ run }: { run: CloudRun }) {
  const [found, sides] = [run.found.value, run.diagnostics.value];
  const last = found ? found.predicted.length - 1 : 0;
  const predicted = found?.predicted[last] ?? null;
  return (
    <>
      <LessonNumbers label="The model of the draws beside the truth">
        <LessonNumber
          label="d_G to the truth"
          metric="intersection.grassmann"
          value={found?.grassmann}
        />
        <LessonNumber
          label="expected from noise"
          metric={`intersection.predicted.${last}`}
          value={predicted}
        />
        <LessonNumber
          label="closed form"
          metric="intersection.closedForm"
          value={found?.closedForm}
        />
        <LessonNumber
          label="R-hat, A and B"
          metric="sides.a.rHatMax"
          value={sides?.a.rHatMax}
          show={(value) => number(value, 3)}
          note={
            <span data-metric="sides.b.rHatMax" data-value={sides?.b.rHatMax ?? undefined}>
              {sides?.b.rHatMax == null ? "–" : number(sides.b.rHatMax, 3)} of B
            </span>
          }
        />
        <LessonNumber
          label="effective draws"
          metric="sides.a.essBulkMin"
          value={sides?.a.essBulkMin}
          show={(value) => number(value, 3)}
          note={
            <span data-metric="sides.b.essBulkMin" data-value={sides?.b.essBulkMin ?? undefined}>
              {sides?.b.essBulkMin == null ? "–" : number(sides.b.essBulkMin, 3)} of B
            </span>
          }
        />
      </LessonNumbers>
      {found && (
        <AdviceLine
          advice={{
            ...cloudVerdict(
              run.draws.value,
              found.grassmann,
              found.closedForm,
              predicted,
              worst(sides?.a.rHatMax, sides?.b.rHatMax),
            ),
            chain: null,
          }}
        />
      )}
    </>
  );
}

function worst(...found: readonly (number | null | undefined)[]): number | null {
  const known = found.filter((value): value is number => value != null);
  return known.length === 0 ? null : Math.max(...known);
}
