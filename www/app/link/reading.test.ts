/** Runs the cases that the engine runs as well (src/settings/links.rs), so that both read the same links. */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import type { Settings } from "../../worker/protocol";
import { MEASURE_NAMES } from "../models/list/measures";
import { DEMO_GROUPS, DEMO_MODELS } from "../state/demos";
import { KINDS, LAYOUTS, STYLES } from "../state/explorer";
import { UNITS } from "../state/preparation";
import { REGIONS } from "../state/regions";
import { LINK_KEYS } from "../state/settings";
import { MAPS, PAGES, PICTURES, TABS, VIEW_MODES } from "../state/view";
import { parseRanges } from "../text/ranges";
import { decimalIn } from "../text/values";
import { readLink } from "./link";
import { linkOfPage, readKeys } from "./reading";
import { linkSentences } from "./told";

interface Cases {
  links: {
    link: string;
    pairs: string[];
    repairs?: string[];
    faults?: string[];
    models?: string;
  }[];
  settings: { link: string; settings: Record<string, unknown> }[];
  values: { key: string; read: Record<string, string | null> }[];
  regions: Record<string, string | null>;
  numbers: Record<string, number | null>;
}

const cases = JSON.parse(readFileSync("tests/fixtures/grammar.json", "utf8")) as Cases;

test("links are read as the engine reads them", () => {
  assert.ok(cases.links.length > 50, `${cases.links.length} links`);
  for (const { link, pairs, repairs = [], faults = [], models = null } of cases.links) {
    const read = readKeys(link);
    assert.deepEqual(
      [...read.given].map(([key, value]) => `${key}=${value}`),
      pairs,
      link,
    );
    assert.deepEqual(read.repairs, repairs, link);
    // What only the page knows of a lesson is tested below.
    if (pairs.includes("page=learn")) continue;
    assert.deepEqual(
      read.faults.map(({ sentence }) => sentence),
      faults,
      link,
    );
    assert.equal(read.unclearModels, models, link);
  }
});

test("settings are read as the command line reads them", () => {
  for (const { link, settings: expected } of cases.settings) {
    const { settings } = readLink(link);
    for (const [name, value] of Object.entries(expected)) {
      const found = settings[name as keyof Settings] ?? settings.prepare[name as "points"] ?? null;
      assert.deepEqual(found, value, `${name} of ${link}`);
    }
  }
});

test("values, regions and numbers are read as the engine reads them", () => {
  for (const { key, read } of cases.values) {
    for (const [text, value] of Object.entries(read)) {
      const { given } = readKeys(`${key}=${encodeURIComponent(text)}`);
      assert.equal(given.get(key), value, `${key}=${text}`);
    }
  }
  for (const [text, ranges] of Object.entries(cases.regions)) {
    assert.equal(parseRanges(text), ranges ?? "invalid", JSON.stringify(text));
  }
  for (const [text, number] of Object.entries(cases.numbers)) {
    assert.equal(decimalIn(text), number, JSON.stringify(text));
  }
});

test("the names in the table of keys are those that the page has", () => {
  const names = {
    page: PAGES,
    demo: DEMO_GROUPS.flatMap(({ demos }) => demos.map(({ id }) => id)),
    room: TABS,
    view: VIEW_MODES,
    map: MAPS,
    region: REGIONS,
    picture: PICTURES,
    measure: MEASURE_NAMES,
    style: STYLES,
    layout: LAYOUTS,
    "unit-a": UNITS,
  };
  for (const [key, expected] of Object.entries(names)) {
    const value = LINK_KEYS.find((known) => known.key === key)?.value;
    assert.ok(value?.kind === "choice", key);
    assert.deepEqual(value.of, [...expected], key);
  }
  const shelf = LINK_KEYS.find(({ key }) => key === "shelf")?.value;
  assert.ok(shelf?.kind === "models" && DEMO_MODELS.every((name) => shelf.of.includes(name)));
  for (const kind of KINDS) assert.equal(readKeys(`explore=b,${kind}`).faults.length, 0, kind);
});

const said = (link: string) => linkSentences(link, readLink(link))?.message.split("\n") ?? [];

test("what cannot be used is named beside what is used instead", () => {
  const [heads] = said("#demo=heads");
  assert.match(heads ?? "", /example “heads”, which there is not; expected: one of heads-sex,/);
  assert.match(heads ?? "", /The example “Heads: male and female” is shown instead\.$/);
  assert.deepEqual(said("#demo=planes&seed=-1&sigma=abc&leaves=100&points=a-b&foo=1"), [
    "“seed=-1” of the link cannot be used; expected: a whole number from 0 to 2⁶⁴ − 1. Used instead: 1.",
    "“sigma=abc” of the link cannot be used; expected: a positive number, or auto. Used instead: auto.",
    "“leaves=100” of the link cannot be used; expected: a number of per cent from 0 to below 100. Used instead: 80.",
    "“points=a-b” of the link cannot be used; expected: numbers of points such as 0-99,120, or map. It is passed over.",
    "The link has the key “foo”, which there is not. It is passed over.",
  ]);
  assert.match(
    said("#a=demo:planes-a").join(),
    /nothing as B; expected: two models\. The example “Heads: male and female” is shown instead\./,
  );
  assert.deepEqual(said("#v=1&amp;demo=planes&sigma=0,01)."), [
    "The link was corrected: “&amp;” is read as “&”. “sigma=0,01).” is read as “sigma=0.01”.",
  ]);
  assert.deepEqual(said("#v=1&engine=0.2&demo=planes&room=measures"), []);
});

test("values of a lesson that are out of their bounds are named, and others are corrected", () => {
  assert.deepEqual(said("#v=1&page=learn&scene=planes&tilt=200&lift=0,5&coefficients=1,9&foo=2"), [
    "“tilt=200” of the link cannot be used; expected: a number from 0 to 90. The nearest value is used instead.",
    "“coefficients=1,9” of the link cannot be used; expected: numbers from -6 to 6, separated by commas. The nearest value is used instead.",
    "The link has the key “foo”, which there is not. It is passed over.",
    "The link was corrected: “lift=0,5” is read as “lift=0.5”.",
  ]);
  assert.match(said("#page=learn&scene=ste").join(), /“scene=ste” .* one of model, agree,/);
  // Keys of other scenes and of a comparison mean nothing here, and say nothing wrong.
  assert.deepEqual(said("#page=learn&scene=step&tilt=20&demo=planes&steps=100"), []);
  assert.deepEqual(said("#page=gallery&foo=1"), []);
});

test("a link is found where somebody wrote it behind the wrong character", () => {
  const of = (address: string) => linkOfPage(new URL(address) as unknown as Location);
  assert.equal(of("https://a.example/x/#demo=planes"), "#demo=planes");
  assert.equal(of("https://a.example/x/?serial#demo=planes"), "#demo=planes");
  assert.equal(of("https://a.example/x/?serial"), "");
  assert.equal(of("https://a.example/x/?ref=mail"), "");
  for (const [address, demo] of [
    ["https://a.example/x/?demo=planes&seed=2", "planes"],
    ["https://a.example/x/?serial&demo=planes", "planes"],
    ["https://a.example/x/?serial%23v=1&demo=planes", "planes"],
  ] as const) {
    assert.equal(readLink(of(address)).demo, demo, address);
    assert.equal(said(of(address)).length, 1, address);
  }
});
