/** Development only: what the mock engine finds of a pair. */
import { completed } from "../app/state/preparation";
import { maskOf } from "../app/text/ranges";
import type { MockModel } from "./mock-models";
import type { EngineError, Inspection, PointSelection, Remedy, Settings } from "./protocol";

/** Which points of A are compared; null where all are. */
export function comparedPoints(a: MockModel, settings: Partial<Settings>): number[] | null {
  const { points, subsample } = completed(settings.prepare);
  const count = a.mean.length / a.dimension;
  let chosen = [...new Array(count).keys()];
  if (points?.by === "region") {
    const mask = maskOf(points.ranges, count);
    chosen = chosen.filter((point) => mask[point] === 1);
  }
  if (points?.by === "map") chosen = chosen.slice(0, 900);
  if (points?.by === "list") chosen = points.a;
  if (subsample !== null && subsample < chosen.length) {
    const step = chosen.length / subsample;
    chosen = Array.from({ length: subsample }, (_, i) => chosen[Math.floor(i * step)] ?? 0);
  }
  return chosen.length === count ? null : chosen;
}

type Offer = Remedy & { done: boolean };

function offersFor(a: MockModel, settings: Partial<Settings>, unlike: boolean): Offer[] {
  const { points, subsample } = completed(settings.prepare);
  const rigid = settings.align === "rigid";
  const crop = points?.by === "map";
  const offers: (Offer | false)[] = [
    (unlike || crop) && {
      id: "map",
      done: crop,
      label: crop ? "Points of the crop" : "Compare the points of the crop",
      sentence: "The smaller model says which points of the larger one its own are.",
      settings: { prepare: { points: crop ? null : { by: "map" } } },
      recommended: true,
    },
    (a.dimension === 3 || rigid) &&
      !unlike && {
        id: "rigid",
        done: rigid,
        label: rigid ? "Aligned rigidly" : "Align B to A",
        sentence: "Turned and shifted onto A, the means are 3.4 mm apart instead of 8.21 mm.",
        settings: { align: rigid ? "none" : "rigid" },
        recommended: !a.name.startsWith("heads"),
      },
    points !== null &&
      !crop && {
        id: "points",
        done: true,
        label: points.by === "list" ? "Points of a list" : "Points of a region",
        sentence: "Only these points are compared.",
        settings: { prepare: { points: null } },
        recommended: false,
      },
    subsample !== null && {
      id: "subsample",
      done: true,
      label: `At most ${subsample} points`,
      sentence: "Evenly spread over the shape.",
      settings: { prepare: { subsample: null } },
      recommended: false,
    },
  ];
  return offers.filter((offer) => offer !== false);
}

export function mockInspection(
  a: MockModel,
  b: MockModel,
  settings: Partial<Settings>,
): Inspection {
  const prepare = completed(settings.prepare);
  const [ofA, ofB] = [a.mean.length / a.dimension, b.mean.length / b.dimension];
  const unlike = ofA !== ofB && prepare.points === null;
  const offers = offersFor(a, settings, unlike);
  const units = {
    a: { stated: prepare.a.unit ?? statedBy(a), guess: "mm" },
    b: { stated: prepare.b.unit ?? statedBy(b), guess: "mm" },
  };
  const shared = {
    points: { a: ofA, b: ofB },
    units,
    remedies: offers.filter(({ done }) => !done),
    applied: offers.filter(({ done }) => done),
  };
  if (unlike) {
    const nothing = { before: null, now: null, rigid: null, similarity: null };
    const problem = differentPoints(ofA, ofB);
    const none = { compared: null, triangles: "different", meanDistance: nothing, scale: null };
    return { ...shared, ...none, problem } as Inspection;
  }
  const before = a.dimension === 2 ? 0.06 : 8.21;
  const now = (settings.align ?? "none") === "none" ? before : 0.4 * before;
  return {
    ...shared,
    problem: null,
    compared: comparedPoints(a, settings)?.length ?? ofA,
    triangles: a.triangles ? "same" : "unknown",
    meanDistance: { before, now, rigid: 0.4 * before, similarity: 0.3 * before },
    scale: 1.0213,
  };
}

function statedBy({ name, unit }: MockModel): string {
  return name.includes("plain") ? "units" : unit;
}

function differentPoints(a: number, b: number): EngineError {
  return {
    code: "point-count-mismatch",
    message: `A has ${a} points, B has ${b}.`,
    hint: "Load two models of the same mesh, or say which points belong together.",
  };
}

export function mockPoints(text: string): PointSelection {
  const rows = text
    .split("\n")
    .filter((line) => line.trim() !== "")
    .map((line) =>
      line
        .trim()
        .split(/[\s,]+/)
        .map(Number),
    );
  if (!rows.every((row) => row.every(Number.isInteger))) {
    throw {
      code: "point-list",
      message: "The list has a line that is no whole number.",
      hint: "One or two whole numbers a line are expected.",
    } satisfies EngineError;
  }
  if (rows.some((row) => row.length === 2)) {
    return { by: "list", a: rows.map((row) => row[0] ?? 0), b: rows.map((row) => row[1] ?? 0) };
  }
  return { by: "region", ranges: rows.map((row) => row[0]).join(",") };
}
