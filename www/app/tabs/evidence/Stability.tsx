import type { EvidenceReport, Report, Side } from "../../../worker/protocol";
import { stabilitySentence } from "../../comparison/groups";
import { keptModes } from "../../state/preparation";
import { change, settings, slots, spoken } from "../../state/state";
import { count, percent } from "../../text/format";
import { plain } from "../../text/phrase";
import { CurveChart } from "../../ui/Curves";
import { DataTable } from "../../ui/DataTable";
import { Phrase } from "../../ui/Phrase";

interface Props {
  report: Report;
  evidence: EvidenceReport;
  side: Side;
}

/** Overlap of the first k modes of random halves of a group, with the number of modes that it suggests. */
export function Stability({ report, evidence, side }: Props) {
  const { overlap, withWhole, dimensions, suggestedModes } = evidence.stability[side];
  const name = side.toUpperCase();
  const sentence = stabilitySentence(evidence, side);
  const byChance = overlap.map((_, i) => Math.min(1, (i + 1) / dimensions));
  const path = `evidence.stability.${side}`;
  return (
    <CurveChart
      name={`stability-${side}`}
      title={`Modes of ${name}`}
      about={<Phrase parts={sentence} />}
      label={plain(sentence)}
      plot={{
        height: 206,
        curves: [
          { key: side, label: "two halves", mark: "circle", values: overlap },
          {
            key: "intersection",
            label: `a half and all of ${name}`,
            mark: "square",
            values: withWhole,
          },
        ],
        chance: { label: "random directions", mean: byChance },
        level: { at: suggestedModes, label: `${count(suggestedModes)} suggested` },
        acrossName: "first modes",
        upName: "overlap of the first modes",
        top: 1,
        up: [0, 0.25, 0.5, 0.75, 1],
        showUp: (value) => `${100 * value}\u202f%`,
      }}
      table={() => (
        <DataTable
          file={`stability-${side}`}
          caption={`Overlap of the first modes of two halves of ${name}`}
          corner="Modes"
          columns={[
            { title: "two halves", show: percent, metric: (row) => `${path}.overlap.${row}` },
            {
              title: `a half and all of ${name}`,
              show: percent,
              metric: (row) => `${path}.withWhole.${row}`,
            },
            { title: "random directions", show: percent },
          ]}
          rows={overlap.map((value, i) => ({
            head: i + 1,
            values: [value, withWhole[i], byChance[i]],
          }))}
        />
      )}
    >
      <UseModes modes={suggestedModes} side={side} all={report.models[side].modes} />
    </CurveChart>
  );
}

/** Compares only so many modes of a model, as its card does. */
function UseModes({ modes, side, all }: { modes: number; side: Side; all: number }) {
  const name = side.toUpperCase();
  const deviations = slots[side].value?.report.standardDeviations;
  const kept = deviations ? keptModes(deviations, settings.value.prepare[side]) : all;
  const text = `${count(modes)} ${modes === 1 ? "mode" : "modes"}`;
  if (kept === modes)
    return (
      <p class="small">
        {text} of {name} are compared.
      </p>
    );
  return (
    <p>
      <button
        type="button"
        onClick={() => {
          change({ prepare: { [side]: { modes, variance: null } } });
          spoken.value = `${text} of ${name} are compared. It can be undone.`;
        }}
      >
        Use {text} of {name}
      </button>
    </p>
  );
}
