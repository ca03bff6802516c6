import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import type { SamplerName, Settings } from "../../worker/protocol";
import { FIRST_DEMO } from "./demos";
import { completed } from "./preparation";
import {
  budgetOf,
  DEFAULTS,
  DIFFERENCES,
  FITS,
  leastDraws,
  MOST_DRAWS,
  PLAUSIBILITIES,
  parseCount,
  parsePercent,
  parsePositive,
  parseSeed,
  percentText,
  RANGES,
  SAMPLERS,
  SIDES_USED,
  settingsKey,
  settingsOf,
} from "./settings";

const rust = readFileSync("src/settings.rs", "utf8");

/** From `start` to the brace that closes what begins there. */
function body(start: string, source = rust): string {
  const from = source.indexOf(start);
  assert.notEqual(from, -1, start);
  let depth = 0;
  for (let i = source.indexOf("{", from); i < source.length; i += 1) {
    if (source[i] === "{") depth += 1;
    if (source[i] === "}") depth -= 1;
    if (depth === 0) return source.slice(from, i + 1);
  }
  return assert.fail(`${start} has no end`);
}

const kebab = (name: string) => name.replace(/(?<=[a-z])[A-Z]/g, "-$&").toLowerCase();
const camel = (name: string) => name.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase());

/** A value as serde writes it. */
function written(text: string): unknown {
  if (text === "None") return null;
  const variant = /^\w+::(\w+)$/.exec(text)?.[1];
  return variant ? kebab(variant) : Number(text.replaceAll("_", ""));
}

function fields(text: string): Record<string, unknown> {
  const pairs = [...text.matchAll(/\b([a-z_]+): ([\w:.]+)/g)];
  return Object.fromEntries(
    pairs.map(([, name = "", value = ""]) => [camel(name), written(value)]),
  );
}

const standard = fields(body("impl Default for Settings"));

test("the defaults are the engine's", () => {
  // The preparation is an object of its own, and the engine's default is to do nothing.
  const { seed, prepare, ...rest } = DEFAULTS;
  for (const [name, value] of Object.entries(rest)) {
    assert.deepEqual(value, standard[name], name);
  }
  assert.equal(seed, String(standard.seed));
  assert.deepEqual(prepare, completed(null));
});

test("the budget of each sampler is the engine's", () => {
  const arms = [
    ...body("pub fn of(sampler: Sampler)").matchAll(
      /((?:Sampler::\w+(?: \| )?)+) =>\s*(?:\{\s*)?(plain|Self \{[^}]*\})/g,
    ),
  ];
  const named = new Map<string, Record<string, unknown>>();
  for (const [, names = "", given = ""] of arms) {
    for (const [, name = ""] of names.matchAll(/Sampler::(\w+)/g)) {
      named.set(kebab(name), fields(given));
    }
  }
  assert.deepEqual([...named.keys()].sort(), Object.keys(SAMPLERS).sort());
  for (const [name, given] of named) {
    const { chains, draws, burnIn, thin } = { ...standard, ...given };
    assert.deepEqual(budgetOf(name as SamplerName), { chains, draws, burnIn, thin }, name);
  }
});

test("the choices are the engine's", () => {
  const variants = (text: string) =>
    [...text.matchAll(/^ {4}([A-Z]\w*)[,({]/gm)].map(([, name = ""]) => kebab(name)).sort();
  const of = (name: string) => variants(body(`pub enum ${name}`));
  assert.deepEqual(Object.keys(SAMPLERS).sort(), of("Sampler"));
  assert.deepEqual(Object.keys(FITS).sort(), of("FitChoice"));
  assert.deepEqual(Object.keys(SIDES_USED).sort(), of("Pooling"));
  assert.deepEqual(Object.keys(PLAUSIBILITIES).sort(), of("Plausibility"));
  const difference = readFileSync("src/pair/difference.rs", "utf8");
  assert.deepEqual(
    [...DIFFERENCES].sort(),
    variants(body("pub enum DifferenceDefinition", difference)),
  );
});

test("the ranges are the engine's", () => {
  const check = body("pub fn check(&self)");
  const ranges = new Map<string, [number, number]>();
  for (const [, name = "", least = "", most = ""] of check.matchAll(
    /\("(\w+)", [^\n]*, ([\d_]+), ([\d_]+)\)/g,
  )) {
    ranges.set(name, [Number(least.replaceAll("_", "")), Number(most.replaceAll("_", ""))]);
  }
  for (const [name, range] of Object.entries(RANGES)) {
    assert.deepEqual([...range], ranges.get(name), name);
  }
  const [, factor, most = ""] =
    /\("draws", self.draws, (\d+) \* self.chains, ([\d_]+)\)/.exec(check) ?? [];
  assert.equal(leastDraws(3), 3 * Number(factor));
  assert.equal(MOST_DRAWS, Number(most.replaceAll("_", "")));
});

test("every setting makes another key", () => {
  const keys = new Set([settingsKey(DEFAULTS)]);
  for (const name of Object.keys(DEFAULTS) as (keyof Settings)[]) {
    keys.add(settingsKey({ ...DEFAULTS, [name]: "other" }));
  }
  assert.equal(keys.size, 1 + Object.keys(DEFAULTS).length);
});

test("settings of a report from before they all existed are filled up", () => {
  const { fit, weighted, difference, ...old } = DEFAULTS;
  const given = { ...old, sigma: 2, sigmaRecommended: true };
  assert.deepEqual(settingsOf(given), DEFAULTS);
  assert.equal(settingsOf({ ...given, sigmaRecommended: false }).sigma, 2);
});

test("σ is a positive length, or nothing for the recommended one", () => {
  assert.equal(parsePositive(" 0,25 "), 0.25);
  assert.equal(parsePositive(""), null);
  assert.equal(parsePositive("0"), "invalid");
  assert.equal(parsePositive("abc"), "invalid");
});

test("a share is typed as per cent and comes back as it was typed", () => {
  for (const text of ["0", "80", "95", "99.9", "33.3"]) {
    assert.equal(percentText(parsePercent(text) as number), text);
  }
  assert.equal(parsePercent("80 %"), 0.8);
  assert.equal(parsePercent("100"), "invalid");
  assert.equal(parsePercent("-1"), "invalid");
  assert.equal(parsePercent(""), "invalid");
});

test("a seed is a whole number of 64 bits", () => {
  assert.equal(parseSeed("18446744073709551615"), "18446744073709551615");
  assert.equal(parseSeed("18446744073709551616"), "invalid");
  assert.equal(parseSeed("-1"), "invalid");
});

test("a count stays within its range", () => {
  assert.equal(parseCount("64", 64, 100), 64);
  assert.equal(parseCount("63", 64, 100), "invalid");
  assert.equal(parseCount("6.5", 1, 100), "invalid");
});

test("the example that the page opens with has the settings it is stored with", () => {
  const { settings } = JSON.parse(readFileSync("www/first/report.json", "utf8"));
  const { sigma = null } = FIRST_DEMO;
  assert.deepEqual(settingsOf(settings), { ...DEFAULTS, sigma });
});
