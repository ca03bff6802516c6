/**
 * Schema of the parameters of a scene, and their text in a link: one key for each, left out if it is the default. An
 * unreadable value is the default, a number out of bounds the nearest bound. Pure.
 */
import { parseSeed } from "../state/settings";

interface NumberParam {
  kind: "number";
  standard: number;
  least: number;
  most: number;
  digits: number;
}
interface ChoiceParam<T extends string> {
  kind: "choice";
  standard: T;
  options: readonly T[];
}
interface ListParam {
  kind: "list";
  standard: readonly number[];
  least: number;
  most: number;
  digits: number;
}
interface SeedParam {
  kind: "seed";
  standard: string;
}
interface FlagParam {
  kind: "flag";
  standard: boolean;
}

export type Param = NumberParam | ChoiceParam<string> | ListParam | SeedParam | FlagParam;
export type Schema = Readonly<Record<string, Param>>;

type ValueOf<P> =
  P extends ChoiceParam<infer T>
    ? T
    : P extends NumberParam
      ? number
      : P extends ListParam
        ? readonly number[]
        : P extends SeedParam
          ? string
          : P extends FlagParam
            ? boolean
            : never;
export type Values<S extends Schema> = { readonly [K in keyof S]: ValueOf<S[K]> };

export const number = (standard: number, least: number, most: number, digits = 3): NumberParam => ({
  kind: "number",
  standard,
  least,
  most,
  digits,
});
export const choice = <const T extends string>(
  standard: NoInfer<T>,
  options: readonly T[],
): ChoiceParam<T> => ({ kind: "choice", standard, options });
export const list = (
  standard: readonly number[],
  least: number,
  most: number,
  digits = 2,
): ListParam => ({ kind: "list", standard, least, most, digits });
export const seed = (): SeedParam => ({ kind: "seed", standard: "1" });
export const flag = (): FlagParam => ({ kind: "flag", standard: false });

export function standardValues<S extends Schema>(schema: S): Values<S> {
  const entries = Object.entries(schema).map(([key, param]) => [key, param.standard]);
  return Object.fromEntries(entries) as Values<S>;
}

export function readValues<S extends Schema>(schema: S, given: URLSearchParams): Values<S> {
  const entries = Object.entries(schema).map(([key, param]) => {
    const text = given.get(key);
    return [key, text === null ? param.standard : read(param, text)];
  });
  return Object.fromEntries(entries) as Values<S>;
}

function read(param: Param, text: string): Param["standard"] {
  switch (param.kind) {
    case "number": {
      const value = Number(text);
      return text === "" || !Number.isFinite(value) ? param.standard : bounded(param, value);
    }
    case "choice":
      return param.options.includes(text) ? text : param.standard;
    case "list": {
      const values = text === "" ? [] : text.split(",").map(Number);
      return values.every(Number.isFinite)
        ? values.map((value) => bounded(param, value))
        : param.standard;
    }
    case "seed": {
      const found = parseSeed(text);
      return found === "invalid" ? param.standard : found;
    }
    case "flag":
      return text === "yes";
  }
}

/** Clamps a number to its bounds and rounds it to the digits of a link, so that an opened link is the same. */
export function bounded(
  { least, most, digits }: Pick<NumberParam, "least" | "most" | "digits">,
  value: number,
): number {
  return Number(Math.min(most, Math.max(least, value)).toFixed(digits)) + 0;
}

/** Keys and values of a link for parameters that differ from their defaults. */
export function writeValues<S extends Schema>(schema: S, values: Values<S>): [string, string][] {
  return Object.entries(schema).flatMap(([key, param]): [string, string][] => {
    const text = written(values[key as keyof S]);
    return text === written(param.standard) ? [] : [[key, text]];
  });
}

/** Text of a value in a link. */
export function written(value: Param["standard"]): string {
  if (typeof value === "boolean") return value ? "yes" : "no";
  return Array.isArray(value) ? value.join(",") : String(value);
}
