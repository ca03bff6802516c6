/**
 * How a set of specimens is divided into A and B: by the words of a column or a threshold of its numbers, with a filter, and
 * with what is taken out. Pure: the readings that say it to the engine.
 */
import type { Column, Side, SpecimenTable } from "../../worker/protocol";
import { escaped, withValue, wordOf } from "./reading";

/** How a set is divided. */
export interface Division {
  /** The column that divides it. */
  column: string;
  /** Of words: which make A. */
  a: string;
  /** Which make B; null for all others. */
  b: string | null;
  /** Of numbers: A is below, B from here on. */
  threshold: number | null;
  /** Only specimens with this word in this column. */
  only: { column: string; word: string } | null;
  /** What is taken out within groups: “size” or a column of numbers. */
  adjust: string | null;
  /** Specimens that are left out, as readings call them. */
  without: readonly string[];
}

/** The conditions of A and of B. */
export function conditionsOf({ column, a, b, threshold }: Division): Record<Side, string> {
  const name = escaped(column);
  if (threshold !== null) return { a: `${name}<${threshold}`, b: `${name}>=${threshold}` };
  const one = escaped(a);
  return { a: `${name}:${one}`, b: b === null ? `${name}:!${one}` : `${name}:${escaped(b)}` };
}

/** The readings of A and of B. */
export function readingsOf(reading: string, division: Division): Record<Side, string> {
  const { only, adjust, without } = division;
  const where = only && `${escaped(only.column)}:${escaped(only.word)}`;
  const common = withValue(
    withValue(withValue(reading, "without", without.join(",")), "where", where),
    "adjust",
    adjust && escaped(adjust),
  );
  const { a, b } = conditionsOf(division);
  return { a: withValue(common, "group", a), b: withValue(common, "group", b) };
}

/** How many specimens A and B would have. */
export function countsOf(table: SpecimenTable, division: Division): Record<Side, number> {
  const place = (name: string) => table.columns.findIndex((column) => column.name === name);
  const [column, filter] = [place(division.column), division.only && place(division.only.column)];
  const counts = { a: 0, b: 0 };
  for (const { key, values } of table.specimens) {
    if (division.without.includes(key)) continue;
    if (division.only && filter !== null && values[filter] !== division.only.word) continue;
    const side = sideOf(values[column] ?? "", division);
    if (side) counts[side] += 1;
  }
  return counts;
}

function sideOf(word: string, { a, b, threshold }: Division): Side | null {
  if (threshold !== null) {
    const number = numberOf(word);
    if (number === null) return null;
    return number < threshold ? "a" : "b";
  }
  if (word === a) return "a";
  if (b === null) return isMissing(word) ? null : "b";
  return word === b ? "b" : null;
}

/** The number that a word of a table writes, with a decimal point or comma; null if it is none. */
export function numberOf(word: string): number | null {
  const number = Number(word.trim().replace(",", "."));
  return word.trim() === "" || !Number.isFinite(number) ? null : number;
}

/** Words for what is not known, as the engine has them (src/formats/input/columns.rs). */
function isMissing(word: string): boolean {
  return /^[+-]?(|na|nan|n\/a|null|none|missing|\?|\.)$/i.test(word);
}

/** How a set is divided at first: by its first column of groups, else of numbers at their middle; null without any. */
export function firstDivision(table: SpecimenTable, reading: string): Division | null {
  const without = (wordOf(reading, "without") ?? "").split(",").filter((name) => name !== "");
  const column =
    table.columns.find(({ kind, values }) => kind === "groups" && values.length > 1) ??
    table.columns.find(({ kind }) => kind === "numbers");
  if (!column) return null;
  return { ...dividedBy(table, column), only: null, adjust: null, without };
}

/** A division by another column. */
export function dividedBy(
  table: SpecimenTable,
  column: Column,
): Pick<Division, "column" | "a" | "b" | "threshold"> {
  const { name, kind, values } = column;
  if (kind === "numbers") {
    const numbers = numbersOf(table, name).toSorted((one, other) => one - other);
    const middle = numbers[Math.floor(numbers.length / 2)] ?? 0;
    return { column: name, a: "", b: null, threshold: middle };
  }
  // The two largest groups.
  const [one, two] = values.toSorted((x, y) => y.count - x.count);
  const pair = [one?.word ?? "", two?.word ?? ""].toSorted();
  return { column: name, a: pair[0] ?? "", b: pair[1] ?? null, threshold: null };
}

/** The numbers of a column. */
export function numbersOf(table: SpecimenTable, name: string): number[] {
  const place = table.columns.findIndex((column) => column.name === name);
  return table.specimens.flatMap(({ values }) => numberOf(values[place] ?? "") ?? []);
}

/** Specimens that a model takes at least. */
export const FEWEST = 3;
