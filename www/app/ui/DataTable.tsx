import { number } from "../text/format";
import { SaveTable } from "./SaveTable";

export interface Column {
  title: string;
  show?: (value: number) => string;
  /** Paths in the report, if the values are from there. */
  metric?: (row: number) => string | undefined;
}

export interface DataRow {
  head: string | number;
  values: readonly (number | null | undefined)[];
}

interface Props {
  /** Name of the CSV file. */
  file: string;
  caption: string;
  /** Title of the column of row heads. */
  corner: string;
  columns: readonly Column[];
  rows: readonly DataRow[];
}

/** Table of the numbers of a plot: rounded on the page, unrounded in the CSV file. */
export function DataTable({ file, caption, corner, columns, rows }: Props) {
  return (
    <SaveTable file={file} of={caption}>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls must be reached by keys */}
      <section class="scrolled" tabIndex={0} aria-label={caption}>
        <table class="numbers data-table">
          <caption>{caption}</caption>
          <thead>
            <tr>
              <th scope="col">{corner}</th>
              {columns.map(({ title }) => (
                <th key={title} scope="col">
                  {title}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {rows.map(({ head, values }, row) => (
              <tr key={head}>
                <th scope="row">{head}</th>
                {columns.map((column, i) => (
                  <Cell key={column.title} column={column} row={row} value={values[i]} />
                ))}
              </tr>
            ))}
          </tbody>
        </table>
      </section>
    </SaveTable>
  );
}

interface CellProps {
  column: Column;
  row: number;
  value: number | null | undefined;
}

function Cell({ column: { show = number, metric }, row, value }: CellProps) {
  if (value == null || !Number.isFinite(value)) {
    return (
      <td>
        <span class="dim">–</span>
      </td>
    );
  }
  return (
    <td data-value={value} data-metric={metric?.(row)}>
      {show(value)}
    </td>
  );
}
