import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import type { Settings } from "../../worker/protocol";
import { FIRST_DEMO } from "./demos";
import {
  ALIGNMENTS,
  choicesOf,
  DEFAULTS,
  FITS,
  PLAUSIBILITIES,
  parseCount,
  parsePercent,
  parsePositive,
  parseSeed,
  percentText,
  SAMPLERS,
  SIDES_USED,
  settingsKey,
  settingsOf,
} from "./settings";

test("the choices that the page explains are those that the engine has", () => {
  const explained = { sampler: SAMPLERS, fit: FITS, pooling: SIDES_USED, align: ALIGNMENTS };
  for (const [name, options] of Object.entries({ ...explained, plausibility: PLAUSIBILITIES })) {
    assert.deepEqual(Object.keys(options), [...choicesOf(name as "fit")], name);
  }
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
