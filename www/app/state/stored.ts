/** Loads the comparison that is stored with the page, which is shown before the engine has started. */
import type { Report, Settings } from "../../worker/protocol";
import { FIRST_DEMO } from "./demos";
import { settingsOf } from "./settings";
import { comparisonKey, modelKey } from "./state";

export interface Stored {
  report: Report;
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

/** The stored comparison; null if there is none: the page then runs it. */
export async function fetchStored(): Promise<Stored | null> {
  try {
    const response = await fetch("first/report.json");
    if (!response.ok) return null;
    const text = await response.text();
    const report = JSON.parse(text) as Report;
    const settings = settingsOf(report.settings);
    const demo = (name: string) => modelKey({ kind: "demo", name }, "", false);
    const key = comparisonKey(demo(FIRST_DEMO.a), demo(FIRST_DEMO.b), settings);
    return { report, text, settings, key, draws: fetchDraws };
  } catch {
    return null;
  }
}
