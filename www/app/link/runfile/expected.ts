/** Reads which models a run file or link expects, and compares them with the open ones. Pure. */
import type {
  KnownShapes,
  ModelReport,
  Report,
  RunFile,
  Settings,
  Sides,
} from "../../../worker/protocol";
import { completed } from "../../state/preparation";
import { DEFAULTS, settingsOf } from "../../state/settings";
import type { LinkState } from "../link";

export interface ExpectedModel {
  /** Null if a link does not state it. */
  name: string | null;
  part: string | null;
  /** How it was read, "" for nothing said. */
  reading: string;
  /** `demo:NAME`, an address, or null for the visitor's own file. */
  source: string | null;
  /** Hash of its content, or the start of it; older reports have none. */
  fingerprint: string | null;
  /** The shapes beside it, null for none; a link does not state them. */
  shapes?: KnownShapes | null;
}

/** A run file or link whose models are not open yet. */
export interface ExpectedRun {
  /** Name of its file; null for a link. */
  file: string | null;
  /** The other keys of a link. */
  link: LinkState | null;
  models: Sides<ExpectedModel>;
  settings: Settings;
  /** Version of the engine that wrote it, if stated. */
  engine: string | null;
  /** The report, if it is one. */
  report: Report | null;
}

/** Largest size of a run file or report in bytes: a report of a few hundred modes has a few hundred kilobytes. */
export const LARGEST_RUN = 16e6;

/** Whether the text of a .json is a run file or report, possibly damaged, and not a model. */
export function looksLikeRun(text: string): boolean {
  if (/"shapevenn"\s*:\s*\d/.test(text)) return true;
  return (
    /"schema"\s*:\s*\d/.test(text) && ['"models"', '"settings"'].every((k) => text.includes(k))
  );
}

/** The expected models and settings of a run file that the engine has read. */
export function expectedRun(
  file: string,
  text: string,
  run: RunFile,
  version: string,
): ExpectedRun {
  const whole = JSON.parse(text.replace(/^\ufeff/, "")) as { engine?: unknown } & Partial<Report>;
  const engine = typeof whole.engine === "string" ? whole.engine : null;
  const model = (side: "a" | "b"): ExpectedModel => {
    const { name, part, reading, source, fingerprint, shapes } = run.models[side];
    return {
      name,
      part: part || null,
      reading: reading ?? "",
      source: source || null,
      fingerprint: fingerprint || null,
      // Shapes of the model's own file have no fingerprint.
      shapes: shapes?.fingerprint ? shapes : null,
    };
  };
  return {
    file,
    link: null,
    engine,
    models: { a: model("a"), b: model("b") },
    settings: chosen(run.settings, engine === version),
    report: whole.intersection ? (whole as Report) : null,
  };
}

/**
 * The settings as they were chosen: a recommended σ is recommended again. Another version of the engine might
 * recommend another σ, so it gets the number.
 */
function chosen(given: Settings & { sigmaRecommended?: boolean }, same: boolean): Settings {
  const { sigmaRecommended = false, ...rest } = given;
  const { sigma } = rest;
  return settingsOf({
    ...DEFAULTS,
    ...rest,
    prepare: completed(rest.prepare),
    sigma,
    sigmaRecommended: same && sigmaRecommended,
  });
}

/**
 * Whether the open model is the expected one; "unknown" without a fingerprint, "missing" if nothing is open, "shapes" if
 * the shapes beside it are others.
 */
export type Verdict = "same" | "other" | "unknown" | "missing" | "shapes";

export interface OpenModel {
  report: Pick<ModelReport, "name" | "fingerprint" | "shapes">;
  /** Its source as a run file states it. */
  source: string | null;
}

export function verdictOf(expected: ExpectedModel, open: OpenModel | null): Verdict {
  if (open === null) return "missing";
  const { fingerprint } = open.report;
  if (expected.fingerprint !== null && fingerprint) {
    if (!fingerprint.startsWith(expected.fingerprint)) return "other";
    const { shapes } = expected;
    const found = open.report.shapes?.fingerprint ?? null;
    return shapes === undefined || (shapes?.fingerprint ?? null) === found ? "same" : "shapes";
  }
  // A run file that was written by hand may state only the sources of its models.
  return expected.source !== null && expected.source === open.source ? "same" : "unknown";
}

/** What to do about one of the models; null if it is the right one. */
export function adviceOf(
  expected: ExpectedModel,
  open: OpenModel | null,
  side: "a" | "b",
  of: "run file" | "link" = "run file",
): string | null {
  const letter = side.toUpperCase();
  const words = `The ${of} was made with ${modelWords(expected)}`;
  switch (verdictOf(expected, open)) {
    case "same":
      return null;
    case "missing":
      return `${words}; open it as ${letter}.`;
    case "shapes": {
      const { shapes } = expected;
      return shapes
        ? `${words}, with the ${shapes.count} shapes of “${shapes.name}” (${shortened(shapes.fingerprint ?? undefined)}) beside it; add them as the shapes of ${letter}.`
        : `${words}, without shapes beside it; take back those of ${letter}.`;
    }
    case "unknown":
      return `${words}; whether that is what is open as ${letter} cannot be told without fingerprints.`;
    case "other": {
      const found = `“${open?.report.name}” (${shortened(open?.report.fingerprint)})`;
      if (expected.source !== null && expected.source === open?.source) {
        return `The ${of} was made with another ${modelWords(expected)} than is found there now, ${found}.`;
      }
      return `${words}; open it as ${letter}. What is open is ${found}.`;
    }
  }
}

/** “male.h5” (3f2a…), with its part if the file has several. */
export function modelWords({ name, part, fingerprint }: ExpectedModel): string {
  const file = name === null ? "a file" : `“${name}”`;
  const named = part !== null && part !== "shape" ? `${file}, ${part}` : file;
  return fingerprint === null ? named : `${named} (${shortened(fingerprint)})`;
}

function shortened(fingerprint: string | undefined): string {
  return fingerprint ? `${fingerprint.slice(0, 4)}…` : "unknown";
}

/** Path of the first number that differs between two reports, times excepted; null if there is none. */
export function firstDifference(one: Report, other: Report): string | null {
  return differs({ ...one, seconds: null }, { ...other, seconds: null }, "");
}

function differs(one: unknown, other: unknown, path: string): string | null {
  // Some programs write −0 as 0.
  if (one === other) return null;
  if (!isObject(one) || !isObject(other)) return path;
  for (const key of new Set([...Object.keys(one), ...Object.keys(other)])) {
    const found = differs(one[key], other[key], path === "" ? key : `${path}.${key}`);
    if (found !== null) return found;
  }
  return null;
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null;
}
