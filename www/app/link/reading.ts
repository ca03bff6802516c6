/**
 * Reads the keys and values of a link, corrects slips that can mean one thing only, and names what cannot be used.
 *
 * The engine has the same grammar and the same table of keys (src/settings/links.rs), but links are read before it is
 * there; both run the cases of tests/fixtures/grammar.json. Pure.
 */
import type { LinkKey, LinkValue } from "../../worker/protocol";
import type { Param, Schema } from "../learn/params";
import { SCENE_PARAMS, type SceneName } from "../learn/scenes";
import { looksLikeAddress } from "../models/address/address";
import { budgetOf, LINK_KEYS, parsePercent, parseVariance, rangeOfDraws } from "../state/settings";
import { parseRanges } from "../text/ranges";
import { countIn, numberIn, pointed, seedIn } from "../text/values";

/** A link as it is read. */
export interface ReadLink {
  /** The keys and values that can be used, each key once. */
  given: URLSearchParams;
  /** A sentence for everything that was corrected. */
  repairs: string[];
  /** What cannot be used. */
  faults: LinkFault[];
  /** A sentence if it names one model only, or an example besides. */
  unclearModels: string | null;
}

export interface LinkFault {
  key: string;
  sentence: string;
  /** Whether the nearest value that can be used is taken instead. */
  nearest?: boolean;
}

/** Axes of the explorer, and the largest coefficient in standard deviations. */
const MOST_AXES = 10_000;
const MOST_DEVIATIONS = 20;

/** What encloses or ends a link in a sentence, and is pasted along. */
const ENCLOSING = /[)\]}>([{<.,;:!?'"`’‘”“»«…*_]/;
const BLANKS = /^[\s\u200b\u2060]+|[\s\u200b\u2060]+$/g;

const KEYS = new Map(LINK_KEYS.map((known) => [known.key, known]));

/** The address of this page as a link: its fragment, or what somebody wrote behind “?” or “%23” instead. */
export function linkOfPage({ hash, search, origin, pathname }: Location): string {
  const given = search
    .replace(/^\?/, "")
    .split("&")
    .filter((part) => !/^(serial|threads)(=|$)/.test(part))
    .join("&");
  const isLink = given.includes("%23") || KEYS.has(small(cut(given)[0]));
  return hash.length < 2 && isLink ? `${origin}${pathname}?${given}` : hash;
}

/** Reads a fragment, with or without “#”, or a whole address. */
export function readKeys(text: string): ReadLink {
  const { pairs, repairs } = split(text);
  const read: ReadLink = { given: new URLSearchParams(), repairs, faults: [], unclearModels: null };
  const asked = pairs.find(([key]) => key === "page")?.[1];
  const page = asked === undefined ? "compare" : mended(KEYS.get("page")?.value, asked);
  const compares = page === null || page === "compare";
  for (const [key, value] of pairs) {
    const known = KEYS.get(key);
    // A lesson and a comparison may use the same key for different things.
    if (compares && known?.part === "lesson") {
      const sentence = `“${key}=${shown(value)}” of the link has no effect without “page=learn”.`;
      read.faults.push({ key, sentence });
    } else if (known && (compares || known.part === "page")) take(read, known, value);
    else if (compares) {
      const sentence = `The link has the key “${shown(key)}”, which there is not.`;
      read.faults.push({ key, sentence });
    } else read.given.append(key, value);
  }
  if (page === "learn") checkLesson(read);
  if (compares) {
    const keys = new Set(pairs.map(([key]) => key));
    read.unclearModels = unclearModels(read.given, keys);
    checkDraws(read);
  }
  return read;
}

function take(read: ReadLink, known: LinkKey, text: string): void {
  const { key, expected } = known;
  const value = mended(known.value, text);
  if (value === null) {
    const sentence =
      key === "demo"
        ? `The link names the example “${shown(text)}”, which there is not; expected: ${expected}.`
        : `“${key}=${shown(text)}” of the link cannot be used; expected: ${expected}.`;
    read.faults.push({ key, sentence });
    return;
  }
  if (value !== text) read.repairs.push(`“${key}=${shown(text)}” is read as “${key}=${value}”.`);
  const first = read.given.get(key);
  if (first === null) read.given.append(key, value);
  else if (first !== value) {
    const both = `as “${shown(first)}” and as “${shown(value)}”`;
    const sentence = `The link has “${key}” twice, ${both}; expected: one value.`;
    read.faults.push({ key, sentence });
  }
}

/** Checks the scene of a lesson and its values, of which the engine has the bounds. */
function checkLesson(read: ReadLink): void {
  const { given, faults, repairs } = read;
  const fault = (key: string, expected: string) => {
    const sentence = `“${key}=${shown(given.get(key) ?? "")}” of the link cannot be used; expected: ${expected}.`;
    // Lessons take the nearest bound.
    const nearest = numbersIn(given.get(key) ?? "").every((value) => value !== null);
    faults.push({ key, sentence, nearest });
    if (!nearest) given.delete(key);
  };
  const check = (key: string, value: LinkValue, expected: string) => {
    const text = given.get(key);
    if (text === null) return;
    const found = mended(value, text);
    if (found === null) fault(key, expected);
    else if (found !== text) {
      repairs.push(`“${key}=${shown(text)}” is read as “${key}=${found}”.`);
      given.set(key, found);
    }
  };
  const scenes = Object.keys(SCENE_PARAMS);
  check("scene", { kind: "choice", of: scenes }, `one of ${scenes.join(", ")}`);
  check("size", { kind: "choice", of: ["large"] }, "large");
  const asked = given.get("scene");
  const scene: Schema = asked === null ? {} : SCENE_PARAMS[asked as SceneName];
  for (const key of [...given.keys()]) {
    const param = scene[key];
    if (param) check(key, linkValueOf(param), expectedOf(param));
    else if (!KEYS.has(key) && !LESSON_KEYS.has(key)) {
      faults.push({ key, sentence: `The link has the key “${shown(key)}”, which there is not.` });
      given.delete(key);
    }
  }
}

/** The keys of all scenes, and those that only `shapevenn lesson` reads. */
const LESSON_KEYS = new Set([
  ...Object.values<Schema>(SCENE_PARAMS).flatMap((schema) => Object.keys(schema)),
  "plausibility",
  "turned",
]);

function linkValueOf(param: Param): LinkValue {
  switch (param.kind) {
    case "number":
      return { kind: "within", least: param.least, most: param.most };
    case "list":
      return { kind: "list", least: param.least, most: param.most };
    case "choice":
      return { kind: "choice", of: [...param.options] };
    case "flag":
      return { kind: "choice", of: ["yes", "no"] };
    case "seed":
      return { kind: "seed" };
  }
}

function expectedOf(param: Param): string {
  switch (param.kind) {
    case "number":
      return `a number from ${param.least} to ${param.most}`;
    case "list":
      return `numbers from ${param.least} to ${param.most}, separated by commas`;
    case "choice":
      return `one of ${param.options.join(", ")}`;
    case "flag":
      return "yes or no";
    case "seed":
      return "a whole number from 0 to 2⁶⁴ − 1";
  }
}

function unclearModels(given: URLSearchParams, keys: Set<string>): string | null {
  const named = (side: "a" | "b") => {
    const key = [side, `name-${side}`, `hash-${side}`].find((one) => keys.has(one));
    return key === undefined ? null : `${key}=${given.get(key) ?? ""}`;
  };
  const [a, b, demo] = [named("a"), named("b"), given.get("demo")];
  const either = b ?? a;
  if (either !== null && demo !== null) {
    return `The link names the example “${demo}” and also “${shown(either)}”; expected: an example or two models.`;
  }
  if (either === null || (a !== null && b !== null)) return null;
  return `The link names “${shown(either)}” and nothing as ${a === null ? "A" : "B"}; expected: two models.`;
}

/** Every chain has its least number of draws. */
function checkDraws({ given, faults }: ReadLink): void {
  const sampler = (given.get("sampler") ?? "auto") as Parameters<typeof budgetOf>[0];
  const { chains } = budgetOf(sampler);
  const draws = given.get("draws");
  const [least, most] = rangeOfDraws(Number(given.get("chains") ?? chains));
  if (draws === null || Number(draws) >= least) return;
  given.delete("draws");
  const expected = `a whole number from ${grouped(least)} to ${grouped(most)}, eight for each chain`;
  const sentence = `“draws=${draws}” of the link cannot be used; expected: ${expected}.`;
  faults.push({ key: "draws", sentence });
}

function grouped(count: number): string {
  return String(count).replace(/\B(?=(\d{3})+$)/g, ",");
}

/** Whether a text is such a value as it stands. */
function accepts(value: LinkValue, text: string): boolean {
  switch (value.kind) {
    case "choice":
      return value.of.includes(text);
    case "count":
      return countIn(text, value.least, value.most) !== null;
    case "countOrAll":
      return text === "" || text === "all" || countIn(text, value.least, value.most) !== null;
    case "positive":
      return text === "" || text === "auto" || (numberIn(text) ?? 0) > 0;
    case "share":
      return numberIn(text) !== null && parsePercent(text) !== "invalid";
    case "shareOfVariance":
      return numberIn(text) !== null && parseVariance(text) !== "invalid";
    case "seed":
      return seedIn(text) !== null;
    case "within": {
      const found = numberIn(text);
      return found !== null && found >= value.least && found <= value.most;
    }
    case "list":
      return (
        text === "" ||
        numbersIn(text).every((one) => one !== null && one >= value.least && one <= value.most)
      );
    case "range": {
      const [low, high, ...more] = numbersIn(text);
      return low != null && high != null && low < high && more.length === 0;
    }
    case "camera": {
      const found = numbersIn(text);
      return found.length >= 3 && found.length <= 5 && !found.includes(null);
    }
    case "points":
      return text === "map" || parseRanges(text) !== "invalid";
    case "hash":
      return /^[0-9a-f]{8,32}$/i.test(text);
    case "version":
      return /^\d{1,9}(\.\d{1,9}){1,2}$/.test(text);
    case "address":
      return text.startsWith("demo:")
        ? value.demos.includes(text.slice("demo:".length))
        : looksLikeAddress(text);
    case "models":
      return text.split(",").every((name) => value.of.includes(name));
    case "explorer":
      return isExplorer(text);
    case "text":
      return true;
  }
}

function numbersIn(text: string): (number | null)[] {
  return text.split(",").map(numberIn);
}

function isExplorer(text: string): boolean {
  const [space, directions = "modes", ...coefficients] = text.split(",");
  const known =
    space === "intersection"
      ? // Directions that compare two models belong to A or B.
        directions === "modes"
      : (space === "a" || space === "b") &&
        ["modes", "exclusive", "relative", "angles"].includes(directions);
  let axis = 0;
  return (
    known &&
    coefficients.every((text) => {
      const [, place, value = text] = /^(\d{1,5}):(.*)$/.exec(text) ?? [];
      axis = place === undefined ? axis + 1 : Number(place);
      const coefficient = numberIn(value);
      return (
        axis >= 1 &&
        axis <= MOST_AXES &&
        coefficient !== null &&
        Math.abs(coefficient) <= MOST_DEVIATIONS
      );
    })
  );
}

/** The value that a text stands for, if what is wrong with it can be corrected in one way only; null if not. */
function mended(value: LinkValue | undefined, text: string): string | null {
  if (!value) return null;
  if (accepts(value, text)) return text;
  const trimmed = text.replace(BLANKS, "");
  const tried = [trimmed];
  let rest = trimmed;
  while (rest !== "" && ENCLOSING.test(rest.charAt(0))) rest = rest.slice(1);
  // One character after the other: what is left is as much of the text as can be read.
  while (rest !== "") {
    tried.push(rest);
    if (!ENCLOSING.test(rest.charAt(rest.length - 1))) break;
    rest = rest.slice(0, -1).replace(BLANKS, "");
  }
  for (const candidate of tried) {
    const found = spelt(value, candidate);
    if (found) return found;
  }
  return null;
}

/** The value as it is spelt in a link; null if it is none. */
function spelt(value: LinkValue, text: string): string | null {
  const lower = text.toLowerCase();
  let found: string | null | undefined = lower;
  switch (value.kind) {
    case "choice":
      found = value.of.find((name) => name.toLowerCase() === lower);
      break;
    case "positive":
    case "within":
      found = pointed(lower);
      break;
    case "share":
    case "shareOfVariance":
      found = pointed(lower.replace(/\s*%$/, ""));
      break;
  }
  return found && accepts(value, found) ? found : null;
}

/** As much of a text as a sentence can hold. */
function shown(text: string): string {
  const letters = [...text];
  return letters.length > 80 ? `${letters.slice(0, 80).join("")}…` : text;
}

interface Found {
  pairs: [string, string][];
  repairs: string[];
}

/** The keys and values of a link, whatever was done to the characters that part them. */
function split(text: string): Found {
  const repairs: string[] = [];
  const say = (found: string, read: string) => {
    const sentence = `“${found}” is read as “${read}”.`;
    if (!repairs.includes(sentence)) repairs.push(sentence);
  };
  let fragment = fragmentOf(text, say);
  // Programs that pass links on escape them, some twice.
  if (!fragment.includes("=")) {
    const once = unescaped(fragment, false);
    const plain = once.includes("=") ? once : unescaped(once, false);
    if (plain.includes("=")) {
      say("%3D", "=");
      if (plain.includes("&") && !fragment.includes("&")) say("%26", "&");
      fragment = plain;
    }
  }
  const plain = fragment.replace(/&(?:amp;)+/gi, () => {
    say("&amp;", "&");
    return "&";
  });
  const pairs: [string, string][] = [];
  for (const segment of plain.split("&").filter((one) => one !== "")) {
    let [key, value] = cut(segment);
    if (segment.includes("=")) [key, value] = [unescaped(key, true), unescaped(value, true)];
    else {
      const whole = unescaped(segment, true);
      if (whole.includes("=")) say("%3D", "=");
      [key, value] = cut(whole);
    }
    key = knownKey(key, say);
    // “%26” where “&” was meant: what follows is another key. Texts and addresses may have one of their own.
    const kind = KEYS.get(key)?.value.kind;
    const [first = "", ...others] = value.split("&");
    const inner = others.map((part) => part.replace(/^(amp;)+/, ""));
    const nested =
      kind !== undefined &&
      kind !== "text" &&
      kind !== "address" &&
      inner.length > 0 &&
      inner.every((part) => part.includes("=") && KEYS.has(small(cut(part)[0])));
    if (!nested) {
      pairs.push([key, value]);
      continue;
    }
    say("%26", "&");
    pairs.push([key, first]);
    for (const part of inner) {
      const [name, other] = cut(part);
      pairs.push([knownKey(name, say), other]);
    }
  }
  return { pairs, repairs };
}

type Say = (found: string, read: string) => void;

function cut(segment: string): [string, string] {
  const at = segment.indexOf("=");
  return at < 0 ? [segment, ""] : [segment.slice(0, at), segment.slice(at + 1)];
}

const small = (key: string) => key.trim().toLowerCase();

/** A key in small letters and without blanks, if it is then known. */
function knownKey(key: string, say: Say): string {
  const lower = small(key);
  if (lower === key || !KEYS.has(lower)) return key;
  say(shown(key), lower);
  return lower;
}

/** What is behind the “#” of an address; what is behind its “?”, or all, if it has none. */
function fragmentOf(text: string, say: Say): string {
  const whole = text.trim();
  const fragment = behind(whole, say);
  // A “#” too many, escaped or not, and what other programs begin their fragments with.
  const rest = fragment.replace(/^(?:%23|[#?&/!])+/, "");
  if (rest !== fragment) say(`#${fragment.slice(0, fragment.length - rest.length)}`, "#");
  return rest;
}

function behind(text: string, say: Say): string {
  const isAddress = /^(?:https?|file):/i.test(text);
  const hash = text.indexOf("#");
  if (hash >= 0) return text.slice(hash + 1);
  const escaped = text.indexOf("%23");
  if (escaped === 0 || (isAddress && escaped > 0)) {
    say("%23", "#");
    return text.slice(escaped + 3);
  }
  if (!isAddress) return text;
  const query = text.indexOf("?");
  if (query < 0 || !text.includes("=", query)) return "";
  say("?", "#");
  return text.slice(query + 1);
}

/** Without escapes, as browsers read a form; “+” is a blank if `plus` says so. */
function unescaped(text: string, plus: boolean): string {
  const form = plus ? text : text.replaceAll("+", "%2B");
  const [pair] = new URLSearchParams(`x=${form.replaceAll("&", "%26")}`);
  return pair?.[1] ?? "";
}
