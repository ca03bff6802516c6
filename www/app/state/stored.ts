/** Loads the comparison that is stored with the page and its picture, which are shown before the engine has started. */
import type {
  Geometry,
  Region,
  RegionShapes,
  Report,
  Settings,
  Sides,
} from "../../worker/protocol";
import { FIRST_DEMO } from "./demos";
import { settingsOf } from "./settings";
import { comparisonKey, modelKey } from "./state";

/** What the page draws first: the two models, and the five regions without samples. */
export interface StoredPicture {
  geometry: Sides<Geometry>;
  shapes: Record<Region, RegionShapes>;
}

export interface Stored {
  report: Report;
  /** Null if there is none: the picture then comes with the engine. */
  picture: StoredPicture | null;
  text: string;
  settings: Settings;
  key: string;
  /** Downloads the draws, once. */
  draws(): Promise<ArrayBuffer>;
}

let draws: Promise<ArrayBuffer> | null = null;

function fetchDraws(): Promise<ArrayBuffer> {
  draws ??= fetch("first/draws.npz").then((response) => {
    if (!response.ok) throw new Error("There are no stored draws.");
    return response.arrayBuffer();
  });
  return draws;
}

/** The stored comparison, with its picture if it is wanted; null if there is none: the page then runs it. */
export async function fetchStored(pictured: boolean): Promise<Stored | null> {
  const drawn = pictured ? fetchPicture().catch(() => null) : null;
  try {
    const response = await fetch("first/report.json");
    if (!response.ok) return null;
    const [text, picture] = await Promise.all([response.text(), drawn]);
    const report = JSON.parse(text) as Report;
    const settings = settingsOf(report.settings);
    const demo = (name: string) => modelKey({ kind: "demo", name }, "", "");
    const key = comparisonKey(demo(FIRST_DEMO.a), demo(FIRST_DEMO.b), settings);
    return { report, picture, text, settings, key, draws: fetchDraws };
  } catch {
    return null;
  }
}

async function fetchPicture(): Promise<StoredPicture | null> {
  const response = await fetch("first/picture.json");
  if (!response.ok) return null;
  const found = typed(await response.json()) as StoredPicture;
  // The models share their faces, which stand once.
  const { a, b } = found.geometry;
  return { ...found, geometry: { a, b: { ...b, triangles: a.triangles } } };
}

/** With lists of numbers as the typed arrays that the engine would send. */
function typed(value: unknown, name = ""): unknown {
  if (Array.isArray(value)) {
    return name === "triangles" ? Uint32Array.from(value) : Float32Array.from(value);
  }
  if (typeof value !== "object" || value === null) return value;
  return Object.fromEntries(
    Object.entries(value).map(([name, member]) => [name, typed(member, name)]),
  );
}
