/** Writes tables as CSV (RFC 4180), with unrounded numbers. */

/** End of a line, the same as in the tables of the engine. */
const END = "\r\n";

export function csvText(rows: readonly (readonly (string | number)[])[]): string {
  return rows.map((row) => row.map(field).join(",") + END).join("");
}

/** Escapes a name that a spreadsheet would take for a formula. */
function field(value: string | number): string {
  const text = String(value);
  const plain = /^[=+@\t\r]|^-(?!\d)/.test(text) ? `'${text}` : text;
  return /[",\r\n]/.test(plain) ? `"${plain.replaceAll('"', '""')}"` : plain;
}

/** The members of a table cell that are used here. */
export interface TableCell {
  readonly textContent: string | null;
  readonly colSpan: number;
  readonly dataset: { readonly value?: string };
  querySelector(selector: string): { readonly dataset: { readonly value?: string } } | null;
}
export interface TableRows {
  readonly rows: Iterable<{ readonly cells: Iterable<TableCell> }>;
}

/** Rows of an HTML table: unrounded numbers, empty cells for missing ones. */
export function rowsOf(table: TableRows): string[][] {
  return [...table.rows].map(({ cells }) =>
    [...cells].flatMap((cell) => [
      cell.dataset.value ?? cell.querySelector("[data-value]")?.dataset.value ?? wordsOf(cell),
      ...Array.from({ length: cell.colSpan - 1 }, () => ""),
    ]),
  );
}

/** Replaces non-breaking spaces by plain ones. */
function wordsOf(cell: TableCell): string {
  const text = (cell.textContent ?? "").replace(/\s+/g, " ").trim();
  return text === "–" ? "" : text;
}
