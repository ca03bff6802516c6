import type { Report } from "../../../worker/protocol";
import type { Group } from "../../comparison/numbers";
import { sidesDisagree, twoSides } from "../../comparison/words";
import { SIDES_USED } from "../../state/settings";
import { change, settings } from "../../state/state";
import { number } from "../../text/format";
import { Metric, Phrase } from "../../ui/Phrase";
import { SaveTable } from "../../ui/SaveTable";
import { Segments } from "../../ui/Segments";
import { Numbers } from "./Numbers";

const ALONE: Group = {
  title: "Intersection model from each alone",
  columns: ["from A", "from B"],
  rows: [
    {
      label: "Total variance",
      metrics: ["a", "b"].map((side) => `intersection.disagreement.totalVariance.${side}`),
      show: (value) => number(value),
    },
    {
      label: "Largest SD",
      metrics: ["a", "b"].map((side) => `intersection.disagreement.standardDeviations.${side}.0`),
      show: (value) => number(value),
    },
  ],
};

const COMPARED_MODES = [1, 3, 5, 10];

/** Compares the intersection models sampled from A alone and from B alone, and lets one of them be chosen. */
export function TwoSides({ report }: { report: Report }) {
  const sentence = twoSides(report);
  const { pooling } = settings.value;
  if (!sentence && (report.settings.pooling ?? "both") === "both") return null;
  const distances = report.intersection.disagreement?.grassmann ?? [];
  return (
    <details class="more two-sides">
      <summary>
        From A and from B{sidesDisagree(report) && <span class="flag">&nbsp;· they disagree</span>}
      </summary>
      <p data-disagree={sidesDisagree(report)}>
        {sentence ? (
          <Phrase parts={sentence} />
        ) : (
          "This model is sampled from one of the two alone. Choose both to see how much they differ."
        )}
      </p>
      {sentence && <Numbers group={ALONE} report={report} />}
      {distances.length > 0 && (
        <SaveTable file="two-sides-grassmann" of="the Grassmann distance between the two">
          <table class="numbers" data-columns="4">
            <caption>Grassmann distance between the two, radians</caption>
            <thead>
              <tr>
                <td />
                {distances.map((_, i) => (
                  <th key={COMPARED_MODES[i]} scope="col">
                    {COMPARED_MODES[i]}
                  </th>
                ))}
              </tr>
            </thead>
            <tbody>
              <tr>
                <th scope="row">First modes</th>
                {distances.map((value, i) => (
                  <td key={COMPARED_MODES[i]}>
                    <Metric
                      path={`intersection.disagreement.grassmann.${i}`}
                      value={value}
                      text={number(value)}
                    />
                  </td>
                ))}
              </tr>
            </tbody>
          </table>
        </SaveTable>
      )}
      <Segments
        legend="Models from which the intersection is sampled"
        name="pooling"
        value={pooling}
        options={(["both", "a", "b"] as const).map((side) => [
          side,
          SIDES_USED[side].label,
          SIDES_USED[side].help,
        ])}
        onChoose={(side) => change({ pooling: side })}
      />
    </details>
  );
}
