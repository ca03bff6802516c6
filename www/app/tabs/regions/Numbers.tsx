import type { Report } from "../../../worker/protocol";
import { type Group, valueAt } from "../../comparison/numbers";
import { Metric } from "../../ui/Phrase";
import { SaveTable } from "../../ui/SaveTable";

/** A table of numbers of the report; rows that the report does not have are left out. */
export function Numbers({ group, report }: { group: Group; report: Report }) {
  const rows = group.rows
    .map((row) => ({ ...row, values: row.metrics.map((path) => valueAt(report, path)) }))
    .filter(({ values }) => values.some((value) => value !== null));
  if (rows.length === 0) return null;
  return (
    <SaveTable file={fileName(group.title)} of={group.title}>
      <table class="numbers" data-columns={group.columns.length}>
        <caption>{group.title}</caption>
        {group.columns.length > 0 && (
          <thead>
            <tr>
              <td />
              {group.columns.map((column) => (
                <th key={column} scope="col">
                  {column}
                </th>
              ))}
            </tr>
          </thead>
        )}
        <tbody>
          {rows.map(({ label, metrics, values, show }) => (
            <tr key={label}>
              <th scope="row">{label}</th>
              {metrics.map((path, i) => {
                const value = values[i] ?? null;
                return (
                  <td key={path}>
                    {value === null ? (
                      <span class="dim">–</span>
                    ) : (
                      <Metric path={path} value={value} text={show(value, report)} />
                    )}
                  </td>
                );
              })}
            </tr>
          ))}
        </tbody>
      </table>
    </SaveTable>
  );
}

function fileName(title: string): string {
  return title.replace("A∩B", "intersection").replace(/\W+/g, "-").toLowerCase();
}
