/** Tests the sentences about the two groups beside chance, each with both of its outcomes. */
import assert from "node:assert/strict";
import { test } from "node:test";
import type { EvidenceReport } from "../../worker/protocol";
import { plain } from "../text/phrase";
import { madeUpChance, madeUpEvidence } from "./evidence.fixture";
import * as said from "./groups";

const null_ = madeUpEvidence();

test("shapes can be told apart or not", () => {
  const apart: EvidenceReport = {
    ...null_,
    toldApart: { ...null_.toldApart, b: { share: 1, chance: madeUpChance(0.42, 0.2) } },
  };
  assert.equal(
    plain(said.toldApartSentence(apart, "b")),
    "In 20 of 20 cases a left-out shape of B is nearer to B’s model than to A’s; by chance in 42\u202f% (5–95 %: 22\u202f% to 62\u202f%): shapes of B can be told from those of A.",
  );
  assert.match(
    plain(said.toldApartSentence(apart, "a")),
    /^In 10 of 20.*A cannot be told from those of B/,
  );
  const tie = {
    ...null_,
    toldApart: { ...null_.toldApart, a: { ...null_.toldApart.a, share: 0.525 } },
  };
  assert.match(plain(said.toldApartSentence(tie, "a")), /^In 10\.5 of 20/);
});

test("the means differ at some points or at none", () => {
  assert.equal(
    plain(said.pointsSentence(null_)),
    "The means differ at no point by more than chance (family-wise p above 0.05).",
  );
  const discovered = { ...null_, vertices: { p: [0.06], differ: 0, falseDiscovery: 1 } };
  assert.match(
    plain(said.pointsSentence(discovered)),
    /above 0\.05\), at 100\u202f% if one in twenty of these may be false\.$/,
  );
  const some = { ...null_, vertices: { p: [0.01, 0.4], differ: 0.5, falseDiscovery: 0.6 } };
  assert.equal(
    plain(said.pointsSentence(some)),
    "The means differ at 50\u202f% of the points by more than chance (family-wise p ≤ 0.05), at 60\u202f% if one in twenty of these may be false.",
  );
});

test("modes are stable up to one, all of them, one alone, or not even that", () => {
  const of = (overlap: number[], suggestedModes: number) =>
    plain(
      said.stabilitySentence(
        {
          ...null_,
          stability: {
            ...null_.stability,
            a: { overlap, withWhole: overlap, dimensions: 300, suggestedModes },
          },
        },
        "a",
      ),
    );
  assert.equal(of([0.9, 0.8, 0.4], 2), "Modes 1 to 2 of A are stable; from 3 on they are chance.");
  assert.equal(of([0.9, 0.2], 1), "Mode 1 of A is stable; from 2 on they are chance.");
  assert.match(of([0.9, 0.8], 2), /are stable: as many as halves of its shapes can show\.$/);
  assert.match(of([0.2, 0.2], 1), /^No mode of A is stable/);
});

test("a curve is inside its band, below or above it somewhere, or everywhere", () => {
  const [p05, p95] = [
    [1, 1, 1],
    [2, 2, 2],
  ];
  const of = (observed: number[]) =>
    said.bandSentence({ observed, mean: observed, p05: p05 ?? [], p95: p95 ?? [] });
  assert.equal(of([1, 1.5, 2]), "Inside the band of chance everywhere.");
  assert.equal(
    of([0.9, 1.5, 2.1]),
    "Outside the band of chance at 2 of 3 places: below it at 1, above it at 1. By chance alone one in ten is outside.",
  );
  assert.match(of([1.5, 1.5, 0.5]), /at 1 of 3 places: below it at 1\. By/);
  assert.equal(of([3, 3, 3]), "Above the band of chance everywhere.");
  assert.equal(of([0, 0, 0]), "Below the band of chance everywhere.");
});

test("groups of different sizes have their shares at equal numbers beside", () => {
  assert.equal(said.matchedSentence(null_), null);
  const matched = { shapes: 8, varianceAOutsideB: 0.2, varianceBOutsideA: 0.3 };
  assert.match(
    plain(said.matchedSentence({ ...null_, matched }) ?? []),
    /^With 8 shapes of each group, 20\u202f% of the variance of A lies outside B, and 30\u202f%/,
  );
});
