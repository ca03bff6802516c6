import type { Report } from "../../../worker/protocol";
import { angleLabel, angleSentence } from "../../comparison/measured";
import { degrees } from "../../text/format";
import { CurveChart } from "../../ui/Curves";
import { DataTable } from "../../ui/DataTable";

/** Plot and table of the principal angles between the two shape spaces, smallest first. */
export function Angles({ report }: { report: Report }) {
  const angles = report.overlap.principalAnglesDegrees;
  return (
    <CurveChart
      name="angles"
      title="Principal angles"
      about={angleSentence(angles)}
      label={angleLabel(angles)}
      plot={{
        height: 206,
        curves: [
          { key: "intersection", label: "angle", mark: "circle", values: angles, line: false },
        ],
        acrossName: "direction, most alike first",
        upName: "degrees",
        top: 90,
        up: [0, 30, 60, 90],
        showUp: (value) => `${value}°`,
      }}
      table={() => (
        <DataTable
          file="principal-angles"
          caption="Principal angles between A and B, degrees"
          corner="Direction"
          columns={[
            {
              title: "Angle",
              show: degrees,
              metric: (row) => `overlap.principalAnglesDegrees.${row}`,
            },
          ]}
          rows={angles.map((angle, i) => ({ head: i + 1, values: [angle] }))}
        />
      )}
    />
  );
}
