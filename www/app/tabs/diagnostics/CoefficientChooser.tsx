import { batch } from "@preact/signals";
import type { Report } from "../../../worker/protocol";
import { type Coefficient, worstCoefficient } from "../../comparison/diagnosing";
import { R_HAT } from "../../comparison/words";
import { diagnosedMode, diagnosedSide, SIDES } from "../../state/state";
import { count } from "../../text/format";
import { Segments } from "../../ui/Segments";
import { Select } from "../../ui/Select";

interface Props {
  report: Report;
  chosen: Coefficient;
}

/** Chooses the model and the coefficient that the diagnostic plots show. */
export function CoefficientChooser({ report, chosen }: Props) {
  const both = report.intersection.coefficients;
  const modes = both?.[chosen.side].essBulk.length ?? report.models[chosen.side].modes;
  const worst = worstCoefficient(report, chosen.side);
  const apart = (both?.[chosen.side].rHat[worst.mode] ?? 1) >= R_HAT;
  const why = apart ? "the largest R-hat" : "the lowest ESS";
  return (
    <div class="toolbar coefficient-chooser">
      <Segments
        legend="Draws of which model"
        name="diagnosed-side"
        value={chosen.side}
        options={SIDES.map((side) => [side, `Draws from ${side.toUpperCase()}`])}
        onChoose={(side) =>
          // The modes of the two models do not correspond: the choice of the coefficient is reset.
          batch(() => {
            diagnosedSide.value = side;
            diagnosedMode.value = null;
          })
        }
      />
      <label class="coefficient">
        <span>Coefficient</span>
        <Select
          value={String(chosen.mode)}
          options={Array.from({ length: modes }, (_, mode) => [
            String(mode),
            `Mode ${mode + 1}${diagnosticsOf(report, chosen.side, mode)}${mode === worst.mode ? `, ${why}` : ""}`,
          ])}
          onChoose={(mode) => {
            diagnosedMode.value = Number(mode);
            diagnosedSide.value = chosen.side;
          }}
        />
      </label>
    </div>
  );
}

function diagnosticsOf(report: Report, side: "a" | "b", mode: number): string {
  const own = report.intersection.coefficients?.[side];
  const [rHat, ess] = [own?.rHat[mode], own?.essBulk[mode]];
  if (ess === undefined) return "";
  return `: ${rHat == null ? "" : `R-hat ${rHat.toFixed(3)}, `}ESS ${count(ess)}`;
}
