/** Writes the table of pairs as CSV, with unrounded numbers. Pure. */
import type { RelationReport } from "../../../worker/protocol";
import { csvText } from "../../text/csv";
import { MEASURE_NAMES, MEASURES, type MeasureName } from "./measures";

/** `relation(i, j)` of the models called `names`; null if it is not computed. */
type Relations = (row: number, column: number) => RelationReport | null;

/** One measure as a table with a row and a column for each model. */
export function matrixCsv(names: string[], relation: Relations, measure: MeasureName): string {
  const { label, value } = MEASURES[measure];
  return csvText([
    [`${label}: A in rows, B in columns`, ...names],
    ...names.map((name, row) => [
      name,
      ...names.map((_, column) => numberText(relation(row, column), value)),
    ]),
  ]);
}

/** One line for each ordered pair, with all measures. */
export function pairsCsv(names: string[], units: string[], relation: Relations): string {
  const lines = names.flatMap((a, row) =>
    names.flatMap((b, column) => {
      if (row === column) return [];
      const found = relation(row, column);
      const numbers = MEASURE_NAMES.map((name) => numberText(found, MEASURES[name].value));
      const noise = numberText(found, (known) => known.noise);
      return [[a, b, units[row] ?? "", ...numbers, noise, found?.problem?.message ?? ""]];
    }),
  );
  const titles = MEASURE_NAMES.map((name) => {
    const { label, unit } = MEASURES[name];
    return unit === "" || unit === "length" ? label : `${label} (${unit})`;
  });
  return csvText([["A", "B", "Unit of A", ...titles, "Noise", "Problem"], ...lines]);
}

function numberText(
  relation: RelationReport | null,
  value: (relation: RelationReport) => number | null,
): string {
  const found = relation === null || relation.problem ? null : value(relation);
  return found === null || !Number.isFinite(found) ? "" : String(found);
}
