import assert from "node:assert/strict";
import { test } from "node:test";
import { FIRST_DEMO } from "../../www/app/demos";
import { DIAGNOSTICS, GROUPS, valueAt } from "../../www/app/numbers";
import { plain } from "../../www/app/phrase";
import * as words from "../../www/app/words";
import { star } from "../../www/worker/mock-models";
import { mockReport } from "../../www/worker/mock-report";
import type { Progress } from "../../www/worker/protocol";

const seconds = { load: 0, prepare: 0, sample: 0, total: 0 };
const report = mockReport(star("a", 0), star("b", 1), {}, seconds);
const { nouns } = FIRST_DEMO;

test("the headline says what each can make of the other", () => {
  assert.equal(
    plain(words.headline(report, nouns)),
    "Female heads can make 83\u202f% of the variance of male heads; the other way round it is 80\u202f%.",
  );
});

test("every number in a sentence is the report's own", () => {
  const phrases = [
    words.headline(report, nouns),
    words.shared(report),
    words.spaces(report),
    words.differences(report, nouns),
    words.belief(report).phrase,
  ];
  for (const part of phrases.flat()) {
    if (typeof part !== "string")
      assert.equal(part.value, valueAt(report, part.metric), part.metric);
  }
});

test("every number in the tables is in the report", () => {
  for (const { metrics } of [...GROUPS, DIAGNOSTICS].flatMap((group) => group.rows)) {
    for (const path of metrics) {
      if (!/rHatMax|paretoK/.test(path)) assert.notEqual(valueAt(report, path), null, path);
    }
  }
});

test("differences are told apart by how much differs", () => {
  const said = (a: number, b: number) => {
    const { aWithoutB, bWithoutA } = report.differences;
    const differences = {
      aWithoutB: { ...aWithoutB, probability: a },
      bWithoutA: { ...bWithoutA, probability: b },
    };
    return plain(words.differences({ ...report, differences }, nouns));
  };
  assert.match(said(0.999, 0.998), /nearly everything differs/);
  assert.match(said(0.001, 0.002), /almost nothing differs/);
  assert.match(
    said(0.3, 0.6),
    /30\u202f% of male heads and 60\u202f% of female heads are out of the other model’s reach/,
  );
});

test("convergence is only claimed on both counts", () => {
  const at = (rHatMax: number | null, essBulkMin: number | null) =>
    words.liveBelief({ rHatMax, essBulkMin } as Progress);
  assert.equal(at(null, null), "waiting for the first draws");
  assert.equal(at(1.002, 900), "converged so far");
  assert.equal(at(1.002, 100), "not converged yet");
  assert.equal(at(1.05, 900), "not converged yet");
});

test("models that only come near one another are not said to share shapes", () => {
  const apart = { ...report, settings: { ...report.settings, sigma: 0.01 } };
  assert.match(plain(words.shared(report)), /^A shape that both can make/);
  assert.match(plain(words.shared(apart)), /^The shapes that come nearest to both/);
});

test("a warning that the sentences say already is not shown twice", () => {
  const warning = (code: string) => ({ code, message: "", hint: "" });
  const warned = { ...report, warnings: ["nearly-all-differs", "unit"].map(warning) };
  assert.deepEqual(words.furtherWarnings(warned), [warning("unit")]);
});
