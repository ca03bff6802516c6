/** Preparation of the models before a comparison (units, modes, points, alignment): defaults, changes, words. Pure. */
import type {
  PointSelection,
  Preparation,
  Settings,
  SettingsPatch,
  SidePreparation,
} from "../../worker/protocol";
import { count, percent } from "../text/format";
import { rangeCount } from "../text/ranges";

export const AS_IT_IS: SidePreparation = { unit: null, modes: null, variance: null, rebase: false };

export const UNPREPARED: Preparation = {
  a: AS_IT_IS,
  b: AS_IT_IS,
  convert: false,
  mirror: false,
  points: null,
  subsample: null,
};

/** Units that can be declared. */
export const UNITS = ["µm", "mm", "cm", "dm", "m"] as const;

/** The unit that the engine gives if a file states none. */
export const UNSTATED = "units";

/** Returns settings with some of them changed. */
export function patched(settings: Settings, patch: SettingsPatch): Settings {
  const { prepare, ...rest } = patch;
  const { a, b, ...shared } = prepare ?? {};
  const former = settings.prepare;
  return {
    ...settings,
    ...rest,
    prepare: { ...former, ...shared, a: { ...former.a, ...a }, b: { ...former.b, ...b } },
  };
}

/** Completes a preparation with missing parts, as in an older report. */
export function completed(given: SettingsPatch["prepare"] | null | undefined): Preparation {
  const { a, b, ...shared } = given ?? {};
  return { ...UNPREPARED, ...shared, a: { ...AS_IT_IS, ...a }, b: { ...AS_IT_IS, ...b } };
}

/** Resets the settings of a replaced model, and the points, which belong to both. */
export function withoutSides(prepare: Preparation, sides: Record<"a" | "b", boolean>): Preparation {
  return {
    ...prepare,
    a: sides.a ? AS_IT_IS : prepare.a,
    b: sides.b ? AS_IT_IS : prepare.b,
    convert: false,
    mirror: false,
    points: null,
  };
}

/** Whether fewer or other points are compared than the models have. */
export function selectsPoints(prepare: Preparation): boolean {
  return prepare.points !== null || prepare.subsample !== null;
}

/** The compared points in words. */
export function pointsText(points: PointSelection): string {
  switch (points.by) {
    case "region":
      return `a region of ${plural(rangeCount(points.ranges), "point")}`;
    case "map":
      return "the points of the crop, by its index map";
    case "list":
      return `${plural(points.a.length, "pair")} of points from a list`;
  }
}

/** The preparation of a finished comparison in short phrases. */
export function preparationWords(prepare: Preparation): string[] {
  const words: string[] = [];
  for (const side of ["a", "b"] as const) {
    const { unit, modes, variance, rebase } = prepare[side];
    const name = side.toUpperCase();
    const other = side === "a" ? "B" : "A";
    if (unit !== null) words.push(`${name} in ${unit}`);
    if (modes !== null) words.push(`first ${modes} modes of ${name}`);
    if (variance !== null) words.push(`modes with ${percent(variance)} of ${name}’s variance`);
    if (rebase) words.push(`modes of ${name} on the mean of ${other}`);
  }
  if (prepare.convert) words.push("B converted to A’s unit");
  if (prepare.mirror) words.push("B mirrored");
  if (prepare.points) words.push(pointsText(prepare.points));
  if (prepare.subsample !== null) words.push(`at most ${count(prepare.subsample)} points`);
  return words;
}

/** Number of modes that the settings keep, largest first. */
export function keptModes(deviations: number[], side: SidePreparation): number {
  const most = Math.min(side.modes ?? deviations.length, deviations.length);
  if (side.variance === null) return most;
  const total = deviations.reduce((sum, deviation) => sum + deviation ** 2, 0);
  let held = 0;
  const enough = deviations.findIndex((deviation) => {
    held += deviation ** 2;
    // A share of 1 keeps all modes, despite rounding.
    return held >= (side.variance ?? 1) * total * (1 - 1e-12);
  });
  return Math.min(most, enough === -1 ? deviations.length : enough + 1);
}

function plural(number: number, noun: string): string {
  return `${count(number)} ${noun}${number === 1 ? "" : "s"}`;
}
