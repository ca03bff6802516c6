/** Tables on the page, as tests read them: what they hold, and the CSV that they are saved as. */
import { download } from "./harness.mjs";

/** Opens the numbers behind a plot and resolves to the plot. */
export async function showNumbers(page, chart) {
  const figure = page.locator(`[data-chart="${chart}"]`);
  await figure.locator("summary", { hasText: "Show numbers" }).click();
  await figure.getByRole("table").first().waitFor();
  return figure;
}

/** The unrounded values of a table's body, row by row, without the heads of the rows. */
export async function valuesOf(table) {
  return table.locator("tbody tr").evaluateAll((rows) =>
    rows.map((row) =>
      [...row.querySelectorAll("td")].map((cell) => {
        const { value } = (cell.querySelector("[data-value]") ?? cell).dataset;
        return value === undefined ? null : Number(value);
      }),
    ),
  );
}

/** The heads of a table's rows. */
export async function headsOf(table) {
  return (await table.locator("tbody th").allInnerTexts()).map((text) => text.trim());
}

/** Presses the CSV button of a table and resolves to `{name, rows}`. */
export async function saveCsv(page, button) {
  const { name, bytes } = await download(page, () => button.click());
  return { name, rows: parseCsv(bytes.toString("utf8")) };
}

/** A reader of its own, so that what the page writes is not read by what wrote it. */
export function parseCsv(text) {
  const rows = [];
  let [row, field, quoted] = [[], "", false];
  for (let i = 0; i < text.length; i += 1) {
    const letter = text[i];
    if (quoted) {
      if (letter !== '"') field += letter;
      else if (text[i + 1] === '"') {
        field += letter;
        i += 1;
      } else quoted = false;
    } else if (letter === '"') quoted = true;
    else if (letter === ",") {
      row.push(field);
      field = "";
    } else if (letter === "\n") {
      rows.push([...row, field.replace(/\r$/, "")]);
      [row, field] = [[], ""];
    } else field += letter;
  }
  if (field !== "" || row.length > 0) throw new Error("the last line does not end");
  return rows;
}
