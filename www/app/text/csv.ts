/** Tables as CSV (RFC 4180). Every number has all its digits, whatever the table rounds it to. */

/** Lines as the engine ends them in its own tables. */
const END = "\r\n";

export function csvText(rows: readonly (readonly (string | number)[])[]): string {
  return rows.map((row) => row.map(field).join(",") + END).join("");
}

/** A name that begins like a formula would be worked out by a spreadsheet. */
function field(value: string | number): string {
  const text = String(value);
  const plain = /^[=+@\t\r]|^-(?!\d)/.test(text) ? `'${text}` : text;
  return /[",\r\n]/.test(plain) ? `"${plain.replaceAll('"', '""')}"` : plain;
}

/** The few members of a table cell that are read here. */
export interface TableCell {
  readonly textContent: string | null;
  readonly colSpan: number;
  readonly dataset: { readonly value?: string };
  querySelector(selector: string): { readonly dataset: { readonly value?: string } } | null;
}
export interface TableRows {
  readonly rows: Iterable<{ readonly cells: Iterable<TableCell> }>;
}

/** What a table shows, row by row: unrounded where it knows the number, blank where it has none. */
export function rowsOf(table: TableRows): string[][] {
  return [...table.rows].map(({ cells }) =>
    [...cells].flatMap((cell) => [
      cell.dataset.value ?? cell.querySelector("[data-value]")?.dataset.value ?? wordsOf(cell),
      ...Array.from({ length: cell.colSpan - 1 }, () => ""),
    ]),
  );
}

/** Spaces that only keep lines from breaking are of no use in a file. */
function wordsOf(cell: TableCell): string {
  const text = (cell.textContent ?? "").replace(/\s+/g, " ").trim();
  return text === "–" ? "" : text;
}
