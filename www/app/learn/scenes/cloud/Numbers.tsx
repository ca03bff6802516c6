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
        <OfBoth label="R-hat, A and B" sides={sides} name="rHatMax" />
        <OfBoth label="effective draws" sides={sides} name="essBulkMin" />
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

interface OfBothProps {
  label: string;
  sides: CloudRun["diagnostics"]["value"];
  name: "rHatMax" | "essBulkMin";
}

/** A number of the draws from A, and below it that of the draws from B. */
function OfBoth({ label, sides, name }: OfBothProps) {
  const ofB = sides?.b[name];
  return (
    <LessonNumber
      label={label}
      metric={`sides.a.${name}`}
      value={sides?.a[name]}
      show={(value) => number(value, 3)}
      note={
        <span data-metric={`sides.b.${name}`} data-value={ofB ?? undefined}>
          {ofB == null ? "–" : number(ofB, 3)} of B
        </span>
      }
    />
  );
}

function worst(...found: readonly (number | null | undefined)[]): number | null {
  const known = found.filter((value): value is number => value != null);
  return known.length === 0 ? null : Math.max(...known);
}
