import type { Chance } from "../../../worker/protocol";
import { count } from "../../text/format";
import { DataTable } from "../../ui/DataTable";

interface Props {
  file: string;
  caption: string;
  /** Of the chance in the report. */
  path: string;
  chance: Chance;
  show: (value: number) => string;
}

/** Table of the intervals of a histogram and how many relabellings are in each. */
export function HistogramTable({ file, caption, path, chance, show }: Props) {
  const { from, to, counts } = chance.histogram;
  const step = (to - from) / counts.length;
  return (
    <DataTable
      file={file}
      caption={caption}
      corner="Interval"
      columns={[
        { title: "from", show },
        { title: "to", show },
        {
          title: "relabellings",
          show: count,
          metric: (row) => `${path}.histogram.counts.${row}`,
        },
      ]}
      rows={counts.map((found, i) => ({
        head: i + 1,
        values: [from + i * step, from + (i + 1) * step, found],
      }))}
    />
  );
}
