import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { FIRST_DEMO } from "../../www/app/demos";
import {
  budgetOf,
  DEFAULTS,
  parseCount,
  parseSeed,
  parseSigma,
  settingsOf,
} from "../../www/app/settings";

test("the defaults are the engine's", () => {
  const rust = readFileSync("src/comparison/settings.rs", "utf8");
  const body = (start: string) => rust.slice(rust.indexOf(start)).split("\n        }")[0] ?? "";
  const numbers = (text: string) => ({
    chains: Number(/chains: (\d+)/.exec(text)?.[1]),
    draws: Number(/draws: (\d+)/.exec(text)?.[1]),
    burnIn: Number(/burn_in: (\d+)/.exec(text)?.[1]),
    thin: Number(/thin: (\d+)/.exec(text)?.[1]),
  });
  assert.deepEqual(budgetOf("independence"), numbers(body("impl Default for Settings")));
  assert.deepEqual(budgetOf("paper"), numbers(body("Sampler::Paper | Sampler::PaperCorrected =>")));
  assert.equal(DEFAULTS.seed, /seed: (\d+)/.exec(body("impl Default for Settings"))?.[1]);
});

test("σ is a positive length, or nothing for the recommended one", () => {
  assert.equal(parseSigma(" 0,25 "), 0.25);
  assert.equal(parseSigma(""), null);
  assert.equal(parseSigma("0"), "invalid");
  assert.equal(parseSigma("abc"), "invalid");
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
