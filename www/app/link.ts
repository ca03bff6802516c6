/**
 * State ⇄ URL fragment, as plain `k=v` that can be read and edited by hand.
 *
 * Every link of an older page must keep opening: unknown keys are ignored, unreadable values fall
 * back to the default, and what is not given is the default.
 */
import type { Alignment, Region, SamplerName, Settings } from "../worker/protocol";
import { FIRST_DEMO, findDemo } from "./demos";
import {
  ALIGNMENTS,
  budgetOf,
  DEFAULTS,
  parseCount,
  parseSeed,
  parseSigma,
  SAMPLERS,
} from "./settings";
import { type Camera, HOME } from "./viewer/camera";

export const LINK_VERSION = 1;

export type ViewMode = "mean" | "samples" | "sd";
export const VIEW_MODES: ViewMode[] = ["mean", "samples", "sd"];
export const REGIONS: Region[] = ["a", "aWithoutB", "intersection", "bWithoutA", "b"];

/** What of a link is settings of the run. */
export const SETTING_KEYS = "align modes sigma sampler seed chains draws burnin thin".split(" ");

/** Everything that makes the picture. */
export interface LinkState {
  /** A pair that comes with the page, unless both models have addresses. */
  demo: string;
  urls: { a: string; b: string } | null;
  settings: Settings;
  view: ViewMode;
  /** The region shown alone, if one is. */
  region: Region | null;
  /** Seed of the shapes shown in “Samples”. */
  shapes: string;
  camera: Camera;
}

export function defaultLink(): LinkState {
  return {
    demo: FIRST_DEMO.id,
    urls: null,
    settings: DEFAULTS,
    view: "mean",
    region: null,
    shapes: "1",
    camera: HOME,
  };
}

export function writeLink(state: LinkState): string {
  const { settings, camera } = state;
  const pairs: [string, string | number][] = [["v", LINK_VERSION]];
  if (state.urls) pairs.push(["a", state.urls.a], ["b", state.urls.b]);
  else pairs.push(["demo", state.demo]);
  pairs.push(
    ["align", settings.align],
    ["modes", settings.modes ?? "all"],
    ["sigma", settings.sigma ?? "auto"],
    ["sampler", settings.sampler],
    ["seed", settings.seed],
    ["chains", settings.chains],
    ["draws", settings.draws],
    ["burnin", settings.burnIn],
    ["thin", settings.thin],
    ["view", state.view],
  );
  if (state.region) pairs.push(["region", state.region]);
  if (state.shapes !== "1") pairs.push(["shapes", state.shapes]);
  const turned = cameraText(camera);
  if (turned !== cameraText(HOME)) pairs.push(["camera", turned]);
  return pairs.map(([key, value]) => `${key}=${escapeValue(String(value))}`).join("&");
}

export function readLink(fragment: string): LinkState {
  const given = new URLSearchParams(fragment.replace(/^#/, ""));
  const fallback = defaultLink();
  const a = given.get("a");
  const b = given.get("b");
  return {
    demo: findDemo(given.get("demo") ?? "")?.id ?? fallback.demo,
    urls: a && b && isAddress(a) && isAddress(b) ? { a, b } : null,
    settings: readSettings(given),
    view: oneOf(given.get("view"), VIEW_MODES) ?? fallback.view,
    region: oneOf(given.get("region"), REGIONS) ?? null,
    shapes: valid(parseSeed(given.get("shapes") ?? "1"), fallback.shapes),
    camera: readCamera(given.get("camera")),
  };
}

function readSettings(given: URLSearchParams): Settings {
  const samplers = Object.keys(SAMPLERS) as SamplerName[];
  const alignments = Object.keys(ALIGNMENTS) as Alignment[];
  const sampler = oneOf(given.get("sampler"), samplers) ?? DEFAULTS.sampler;
  const budget = budgetOf(sampler);
  const count = (key: string, least: number, most: number, fallback: number) =>
    valid(parseCount(given.get(key) ?? "", least, most), fallback);
  const modes = count("modes", 1, 100_000, 0);
  const chains = count("chains", 2, 1024, budget.chains);
  return {
    sigma: valid(parseSigma(given.get("sigma") ?? "auto"), null),
    seed: valid(parseSeed(given.get("seed") ?? ""), DEFAULTS.seed),
    sampler,
    chains,
    draws: count("draws", 8 * chains, 10_000_000, Math.max(budget.draws, 8 * chains)),
    burnIn: count("burnin", 0, 10_000_000, budget.burnIn),
    thin: count("thin", 1, 100_000, budget.thin),
    modes: modes === 0 ? null : modes,
    align: oneOf(given.get("align"), alignments) ?? DEFAULTS.align,
  };
}

function readCamera(text: string | null): Camera {
  const [yaw, pitch, zoom, x, y] = (text ?? "").split(",").map(Number);
  if (![yaw, pitch, zoom].every((value) => Number.isFinite(value))) return HOME;
  return { yaw: yaw ?? 0, pitch: pitch ?? 0, zoom: zoom || 1, x: x || 0, y: y || 0 };
}

function cameraText(camera: Camera): string {
  const { yaw, pitch, zoom, x, y } = camera;
  const parts = [yaw.toFixed(2), pitch.toFixed(2), zoom.toFixed(2)];
  if (x !== 0 || y !== 0) parts.push(x.toFixed(2), y.toFixed(2));
  return parts.join(",");
}

function valid<T>(value: T | "invalid", fallback: T): T {
  return value === "invalid" ? fallback : value;
}

function oneOf<T extends string>(text: string | null, allowed: readonly T[]): T | undefined {
  return allowed.find((value) => value === text);
}

function isAddress(text: string): boolean {
  return /^https?:\/\//.test(text);
}

/** Only what would break the fragment: the rest stays readable. */
function escapeValue(text: string): string {
  return text.replace(/[%&#+\s]/g, (character) => encodeURIComponent(character));
}
