/**
 * Writes the state of the page as a URL fragment and reads it back: plain `key=value` that can be edited by hand.
 *
 * Links of older pages must keep opening: missing keys have their defaults. What cannot be used has its default, too,
 * and is named (`reading.ts`).
 */
import type {
  Field,
  PointSelection,
  Preparation,
  Sampler,
  Settings,
  SidePreparation,
} from "../../worker/protocol";
import { defaultLesson, type LessonState, readLesson, writeLesson } from "../learn/link";
import { readModels, writeModels } from "../models/address/codec";
import { MEASURE_NAMES, type MeasureName } from "../models/list/measures";
import { type Camera, HOME } from "../state/camera";
import { DEMO_MODELS, FIRST_DEMO, findDemo } from "../state/demos";
import {
  defaultExplorer,
  type ExplorerState,
  readExplorer,
  writeExplorer,
} from "../state/explorer";
import { type LinkedModels, noLinkedModels } from "../state/linked-models";
import { UNITS } from "../state/preparation";
import { REGIONS } from "../state/regions";
import {
  budgetOf,
  choicesOf,
  DEFAULTS,
  ENGINE,
  FIELDS,
  LINK_KEYS,
  parseCount,
  parsePercent,
  parsePositive,
  parseSeed,
  parseVariance,
  percentText,
  rangeOf,
  rangeOfDraws,
  SIGMA_SINCE,
  SUBSAMPLE,
} from "../state/settings";
import {
  FIRST_VIEW,
  MAPS,
  MOST_EXAGGERATION,
  PAGES,
  PICTURES,
  TABS,
  VIEW_MODES,
  type ViewState,
} from "../state/view";
import { parseRanges } from "../text/ranges";
import { readKeys } from "./reading";

export const LINK_VERSION = 1;

/** The keys of a link that are settings of the run. */
export const SETTING_KEYS = LINK_KEYS.flatMap(({ key, part }) => (part === "settings" ? key : []));

/** Longest list of points in a link: longer links are cut by programs that pass them on. */
const LONGEST_RANGES = 2000;

const MOST_VERTICES = 1e7;

const MODES = rangeOf("modes");

const SAMPLER_NAMES = choicesOf("sampler") as Sampler[];

/** Everything that a link holds. */
export interface LinkState extends LinkedModels, ViewState {
  /** The lesson on the page Learn. */
  lesson: LessonState;
  explorer: ExplorerState;
  /** Upper end of the colours of residuals while it is locked; the lower end is 0. */
  heatScale: number | null;
  /** Models on the model list that come with the page, if there are more than two. */
  modelList: string[];
  /** The measure that the table of pairs shows. */
  measure: MeasureName;
}

export function defaultLink(): LinkState {
  return {
    ...FIRST_VIEW,
    ...noLinkedModels(),
    lesson: defaultLesson(),
    explorer: defaultExplorer(),
    heatScale: null,
    modelList: [],
    measure: "variance",
  };
}

export function writeLink(state: LinkState): string {
  const pairs: [string, string | number][] = [["v", LINK_VERSION], ...pagePairs(state)];
  return pairs.map(([key, value]) => `${key}=${escapeValue(String(value))}`).join("&");
}

function pagePairs(state: LinkState): [string, string | number][] {
  const { page, lesson, embed } = state;
  const frame: [string, string][] = embed ? [["embed", "1"]] : [];
  if (page === "compare") return [...frame, ...comparisonPairs(state)];
  return [...frame, ["page", page], ...(page === "learn" ? writeLesson(lesson) : [])];
}

function comparisonPairs(state: LinkState): [string, string | number][] {
  const { settings, camera } = state;
  const pairs: [string, string | number][] = [["engine", ENGINE]];
  if (state.urls) pairs.push(...writeModels(state));
  else pairs.push(["demo", state.demo]);
  pairs.push(
    ...settingPairs(settings),
    ...preparationPairs(settings.prepare),
    ["view", state.view],
    ...lookPairs(state),
  );
  const turned = cameraText(camera);
  if (turned !== cameraText(HOME)) pairs.push(["camera", turned]);
  return pairs;
}

/** Keys of the view that differ from their defaults. */
function lookPairs(state: LinkState): [string, string | number][] {
  const first = defaultLink();
  const plain = (
    [
      ["room", state.tab, first.tab],
      ["map", state.map, first.map],
      ["mode", state.mapMode + 1, first.mapMode + 1],
      ["vertex", state.vertex, first.vertex],
      ["scale", state.scale?.map(shortNumber).join(",") ?? null, null],
      ["heat-scale", state.heatScale === null ? null : shortNumber(state.heatScale), null],
      ["side", state.side, first.side],
      ["coefficient", state.coefficient === null ? null : state.coefficient + 1, null],
      ["region", state.region, first.region],
      ["picture", state.picture, first.picture],
      ["exaggerate", state.exaggeration, first.exaggeration],
      ["shapes", state.shapes, first.shapes],
      ["rank", state.rank, first.rank],
      ["shelf", state.modelList.join(","), first.modelList.join(",")],
      ["measure", state.measure, first.measure],
    ] as const
  ).flatMap(([key, value, standard]): [string, string | number][] =>
    value === standard || value === null ? [] : [[key, value]],
  );
  return [...plain, ...writeExplorer(state.explorer)];
}

/** Keys of settings: some are in every link, the others only if they differ from their defaults. */
function settingPairs(settings: Settings): [string, string][] {
  return FIELDS.filter(
    ({ name, alwaysInLinks }) => alwaysInLinks || settings[name] !== DEFAULTS[name],
  ).map(({ key, name, value }) => [key, settingText(settings[name], value.kind)]);
}

export function settingText(value: string | number | null, kind: Field["value"]["kind"]): string {
  if (value === null) return kind === "countOrAll" ? "all" : "auto";
  return kind === "share" ? percentText(Number(value)) : String(value);
}

/** Keys of the preparation of the models; none for a pair that is compared as it stands. */
function preparationPairs(prepare: Preparation): [string, string | number][] {
  const pairs: [string, string | number][] = [];
  for (const side of ["a", "b"] as const) {
    const { unit, modes, variance } = prepare[side];
    if (unit !== null) pairs.push([`unit-${side}`, unit]);
    if (modes !== null) pairs.push([`modes-${side}`, modes]);
    if (variance !== null) pairs.push([`variance-${side}`, percentText(variance)]);
  }
  const rebased = (["a", "b"] as const).filter((side) => prepare[side].rebase).join("");
  if (rebased !== "") pairs.push(["rebase", rebased]);
  if (prepare.convert) pairs.push(["convert", "yes"]);
  if (prepare.mirror) pairs.push(["mirror", "yes"]);
  const { points, subsample } = prepare;
  if (points?.by === "map") pairs.push(["points", "map"]);
  if (points?.by === "region" && fitsLink(points)) pairs.push(["points", points.ranges]);
  if (subsample !== null) pairs.push(["subsample", subsample]);
  return pairs;
}

/** Whether a link can hold the selection of points: not a list of pairs, nor a region with too many ranges. */
export function fitsLink(points: PointSelection | null): boolean {
  if (points?.by === "list") return false;
  return points?.by !== "region" || points.ranges.length <= LONGEST_RANGES;
}

export function readLink(fragment: string): LinkState {
  const { given, faults } = readKeys(fragment);
  const fallback = defaultLink();
  const page = oneOf(given.get("page"), PAGES) ?? fallback.page;
  const embed = given.get("embed") === "1";
  // A lesson and a comparison may use the same key for different things.
  if (page !== "compare") return { ...fallback, page, embed, lesson: readLesson(given) };
  return {
    page,
    embed,
    lesson: fallback.lesson,
    demo: findDemo(given.get("demo") ?? "")?.id ?? fallback.demo,
    ...readModels(given),
    settings: settingsOfLink(given, new Set(faults.map(({ key }) => key))),
    tab: oneOf(given.get("room"), TABS) ?? fallback.tab,
    map: oneOf(given.get("map"), MAPS) ?? fallback.map,
    mapMode: valid(parseCount(given.get("mode") ?? "", ...MODES), 1) - 1,
    vertex: valid<number | null>(parseCount(given.get("vertex") ?? "", 0, MOST_VERTICES), null),
    explorer: readExplorer(given),
    scale: readScale(given.get("scale")),
    heatScale: valid(parsePositive(given.get("heat-scale") ?? ""), null),
    side: oneOf(given.get("side"), ["a", "b"] as const) ?? null,
    coefficient: readCoefficient(given.get("coefficient")),
    view: oneOf(given.get("view"), VIEW_MODES) ?? fallback.view,
    region: oneOf(given.get("region"), REGIONS) ?? null,
    picture: oneOf(given.get("picture"), PICTURES) ?? fallback.picture,
    exaggeration: readExaggeration(given.get("exaggerate")),
    shapes: valid(parseSeed(given.get("shapes") ?? "1"), fallback.shapes),
    rank: valid(parseCount(given.get("rank") ?? "", 0, 100), fallback.rank),
    modelList: readModelList(given.get("shelf")),
    measure: oneOf(given.get("measure"), MEASURE_NAMES) ?? fallback.measure,
    camera: readCamera(given.get("camera")),
  };
}

/** A link that says nothing about settings has those of its example, as the comparison that is stored with the page. */
function settingsOfLink(given: URLSearchParams, unusable: Set<string>): Settings {
  const settings = readSettings(given);
  const silent = !SETTING_KEYS.some((key) => given.has(key) || unusable.has(key));
  const isFirst =
    !given.has("a") && !given.has("b") && !given.has("name-a") && !given.has("name-b");
  const demo = findDemo(given.get("demo") ?? FIRST_DEMO.id);
  const sigma = silent && isFirst && demo === FIRST_DEMO ? FIRST_DEMO.sigma : undefined;
  return sigma === undefined ? settings : { ...settings, sigma };
}

function readSettings(given: URLSearchParams): Settings {
  const sampler = oneOf(given.get("sampler"), SAMPLER_NAMES) ?? DEFAULTS.sampler;
  const standard: Settings = { ...DEFAULTS, ...budgetOf(sampler) };
  const read = FIELDS.map((field) => [
    field.name,
    readSetting(field, given.get(field.key) ?? "", standard[field.name]),
  ]);
  const settings: Settings = { ...standard, ...Object.fromEntries(read) };
  const [least, most] = rangeOfDraws(settings.chains);
  const draws = parseCount(given.get("draws") ?? "", least, most);
  return {
    ...settings,
    draws: valid(draws, Math.max(standard.draws, least)),
    prepare: readPreparation(given),
  };
}

type SettingValue = string | number | null;

function readSetting({ value }: Field, text: string, standard: SettingValue): SettingValue {
  switch (value.kind) {
    case "choice":
      return oneOf(text, value.of) ?? standard;
    case "count":
      return valid<SettingValue>(parseCount(text, value.least, value.most), standard);
    case "countOrAll":
      return valid<SettingValue>(parseCount(text, value.least, value.most), null);
    case "positive":
      return valid(parsePositive(text), null);
    case "share":
      return valid<SettingValue>(parsePercent(text), standard);
    case "seed":
      return valid<SettingValue>(parseSeed(text), standard);
  }
}

function readPreparation(given: URLSearchParams): Preparation {
  const rebased = given.get("rebase") ?? "";
  const count = (key: string, [least, most]: readonly [number, number]) =>
    valid<number | null>(parseCount(given.get(key) ?? "", least, most), null);
  const side = (name: "a" | "b"): SidePreparation => ({
    unit: oneOf(given.get(`unit-${name}`), UNITS) ?? null,
    modes: count(`modes-${name}`, MODES),
    variance: valid<number | null>(parseVariance(given.get(`variance-${name}`) ?? ""), null),
    rebase: rebased.includes(name),
  });
  const points = given.get("points");
  const ranges = parseRanges(points ?? "");
  return {
    a: side("a"),
    b: side("b"),
    convert: given.get("convert") === "yes",
    mirror: given.get("mirror") === "yes",
    points:
      points === "map" ? { by: "map" } : ranges === "invalid" ? null : { by: "region", ranges },
    subsample: count("subsample", SUBSAMPLE),
  };
}

/**
 * Whether a link leaves σ to the engine and may be from a version that chose σ by another rule: it names an older
 * one, or none. An empty address is no link.
 */
export function mayMeanAnotherSigma(fragment: string): boolean {
  const { given } = readKeys(fragment);
  const { page, settings } = readLink(fragment);
  if (given.size === 0 || page !== "compare" || settings.sigma !== null) return false;
  const [major, minor] = versionOf(given.get("engine") ?? "");
  const [sinceMajor, sinceMinor] = versionOf(SIGMA_SINCE);
  return major < sinceMajor || (major === sinceMajor && minor < sinceMinor);
}

/** Major and minor number of a version such as “0.2”; that before all others for anything else. */
function versionOf(text: string): [number, number] {
  const [, major, minor] = /^(\d+)\.(\d+)/.exec(text) ?? [];
  return major === undefined || minor === undefined ? [-1, 0] : [Number(major), Number(minor)];
}

/** Rounds to the digits of single precision. */
function shortNumber(value: number): string {
  return String(Number(value.toPrecision(7)));
}

function readScale(text: string | null): [number, number] | null {
  const [low = Number.NaN, high = Number.NaN, ...more] = (text ?? "").split(",").map(Number);
  return low < high && Number.isFinite(high - low) && more.length === 0 ? [low, high] : null;
}

function readCoefficient(text: string | null): number | null {
  const mode = parseCount(text ?? "", ...MODES);
  return mode === "invalid" ? null : mode - 1;
}

function readExaggeration(text: string | null): number {
  const value = Number(text ?? 0);
  return value >= 0 && value <= MOST_EXAGGERATION ? value : 0;
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

/** The known models of a list, each once. */
function readModelList(text: string | null): string[] {
  const names = new Set((text ?? "").split(","));
  return [...names].filter((name) => DEMO_MODELS.includes(name));
}

/** Escapes only what would break the fragment, so that the rest stays readable. */
function escapeValue(text: string): string {
  return text.replace(/[%&#+\s]/g, (character) => encodeURIComponent(character));
}
