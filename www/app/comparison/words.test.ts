import assert from "node:assert/strict";
import { test } from "node:test";
import type { Inspection, ModelReport, Progress, Report } from "../../worker/protocol";
import { FIRST_DEMO } from "../state/demos";
import { completed } from "../state/preparation";
import { plain } from "../text/phrase";
import { DIAGNOSTICS, GROUPS, valueAt } from "./numbers";
import { madeUpReport } from "./report.fixture";
import * as words from "./words";

const report = madeUpReport();
const { nouns } = FIRST_DEMO;

test("the headline says how far the shapes of one lie from the other", () => {
  assert.equal(
    plain(words.headline(report, nouns)),
    "A male head lies 3.02\u202funits from the nearest that the female model can make.",
  );
  const { answer: _, ...older } = report;
  assert.deepEqual(
    words.headline(older as Report, nouns),
    words.variances(report, nouns),
    "a report of an older engine",
  );
  assert.equal(
    plain(words.variances(report, nouns)),
    "About their own mean, the female model holds 83\u202f% of how male heads vary, the male model 80\u202f% of how female heads do.",
  );
});

test("every number in a sentence is the report's own", () => {
  const phrases = [
    words.headline(report, nouns),
    words.variances(report, nouns),
    words.shared(report),
    words.spaces(report),
    words.differences(report, nouns),
    words.belief(report).phrase,
    words.nearlyTheModel(report) ?? [],
    words.exclusive(report, "a") ?? [],
    words.exclusive(report, "b") ?? [],
    words.worstModes(report) ?? [],
    words.twoSides(report) ?? [],
  ];
  assert.ok(phrases.every((phrase) => phrase.length > 0));
  for (const part of phrases.flat()) {
    if (typeof part !== "string")
      assert.equal(part.value, valueAt(report, part.metric), part.metric);
  }
});

test("every number in the tables is in the report", () => {
  for (const { metrics } of [...GROUPS, DIAGNOSTICS].flatMap((group) => group.rows)) {
    for (const path of metrics) {
      if (!/rHatMax|paretoK|importanceEss/.test(path))
        assert.notEqual(valueAt(report, path), null, path);
    }
  }
});

test("differences that a run was ended before are not said to be none", () => {
  const { aWithoutB, bWithoutA } = report.differences;
  const undrawn = (side: typeof aWithoutB) => ({
    ...side,
    probability: 0,
    diagnostics: { ...side.diagnostics, evaluations: 0, draws: 0 },
  });
  const warnings = [{ code: "cancelled", message: "", hint: "" }];
  const said = (differences: typeof report.differences) =>
    plain(words.differences({ ...report, warnings, differences }, nouns));
  assert.match(
    plain(
      words.differences(
        { ...report, differences: { aWithoutB, bWithoutA: undrawn(bWithoutA) } },
        nouns,
      ),
    ),
    /and 0\u202f% of female heads cannot be made/,
    "an empty difference of a run that was not ended is no unfinished one",
  );
  assert.equal(
    said({ aWithoutB: undrawn(aWithoutB), bWithoutA: undrawn(bWithoutA) }),
    "The run was ended before the differences were drawn.",
  );
  assert.match(
    said({ aWithoutB, bWithoutA: undrawn(bWithoutA) }),
    /of male heads are in A∖B; the run was ended before B∖A was drawn\.$/,
  );
});

test("differences are told apart by how much differs", () => {
  const said = (a: number, b: number, of = report) => {
    const { aWithoutB, bWithoutA } = report.differences;
    const differences = {
      aWithoutB: { ...aWithoutB, probability: a },
      bWithoutA: { ...bWithoutA, probability: b },
    };
    return plain(words.differences({ ...of, differences }, nouns));
  };
  assert.match(said(0.999, 0.998), /nearly everything differs/);
  assert.match(said(0.001, 0.002), /almost nothing differs/);
  assert.ok(report.reach, "there is a reach");
  const { aToB, bToA } = report.reach;
  const inside = { ...report.reach, aToB: { ...aToB, mean: 0 }, bToA: { ...bToA, mean: 0 } };
  assert.match(
    said(0, 0, { ...report, reach: inside }),
    /cannot be made by the other model, at any σ: each spans the shapes of the other\.$/,
  );
  assert.match(
    said(0.3, 0.6),
    /30\u202f% of male heads and 60\u202f% of female heads cannot be made by the other model at this σ/,
  );
});

test("convergence is only claimed on both counts", () => {
  const at = (rHatMax: number | null, essBulkMin: number | null) =>
    words.liveBelief({ rHatMax, essBulkMin } as Progress);
  assert.equal(at(null, null), "waiting for the first draws");
  assert.equal(at(1.002, 900), words.LOOKS_WELL);
  assert.doesNotMatch(words.LOOKS_WELL, /converged/);
  assert.equal(at(1.002, 100), "not converged yet");
  assert.equal(at(1.05, 900), "not converged yet");
});

test("models that only come near one another are not said to share shapes", () => {
  const apart = { ...report, settings: { ...report.settings, sigma: 0.01 } };
  assert.match(plain(words.shared(report)), /^A shape that both can make/);
  assert.match(plain(words.shared(apart)), /^The shapes that come nearest to both/);
  const warnings = [{ code: "implausible-intersection", message: "", hint: "" }];
  assert.match(
    plain(words.shared({ ...report, warnings })),
    /^No plausible shape is in both\. Those of A∩B, far out in each, lie /,
  );
  const { intersection } = report;
  const exact = { ...intersection, meanDistance: { mean: 1e-12, sd: 1e-12 } };
  assert.match(
    plain(words.shared({ ...report, intersection: exact })),
    /^A shape that both can make lies 0 ± 0\u202funits from the nearest/,
  );
});

test("a warning that the sentences say already is not shown twice", () => {
  const warning = (code: string) => ({ code, message: "", hint: "" });
  const warned = { ...report, warnings: ["nearly-all-differs", "unit"].map(warning) };
  assert.deepEqual(words.furtherWarnings(warned), [warning("unit")]);
});

/** The report with another intersection. */
function withIntersection(part: Partial<typeof report.intersection>) {
  return { ...report, intersection: { ...report.intersection, ...part } };
}

test("the page says converged only if the engine does, whatever the diagnostics are", () => {
  const { diagnostics } = report.intersection;
  const said = (part: Partial<typeof diagnostics>) => {
    const found = withIntersection({ diagnostics: { ...diagnostics, ...part } });
    return plain(words.belief(found).phrase);
  };
  assert.match(said({ converged: true }), /^Converged: R-hat 1\.0021/);
  assert.match(said({ converged: false }), /^Not converged yet/);
  const byWeights = { converged: true, rHatMax: 1.2, essBulkMin: 30 };
  assert.match(
    said(byWeights),
    /^Converged: Pareto k 0\.21, effective size of the weights 3804\.$/,
  );
  const old = { importanceEss: null, paretoK: null };
  assert.match(said(old), /at least 7412 effective draws for every mode\.$/);
});

test("a report of an older engine leaves the new sentences out", () => {
  const old = withIntersection({
    inference: null,
    accuracy: null,
    disagreement: null,
    coefficients: null,
  });
  assert.equal(words.inferred(old, "a"), null);
  assert.equal(words.unsettled(old), null);
  assert.equal(words.twoSides(old), null);
  assert.equal(words.worstModes(old), null);
  assert.equal(words.sidesDisagree(old), false);
});

test("it is said which sampler ran on a side, why, and what the moments come from", () => {
  assert.equal(
    words.inferred(report, "a"),
    "Independence sampler: the fit is good: Pareto k 0.21, acceptance 0.83. Built on the variational fit; mean and variance come from the fit in closed form; the correction by weighted draws is below its standard error.",
  );
  assert.match(
    words.inferred(report, "b") ?? "",
    /^Hamiltonian Monte Carlo: .* corrected by weighted/,
  );
});

test("the worst mode is the worst of both sides", () => {
  const list = (values: number[]) => ({
    rHat: values.map((value) => 1 + value / 1000),
    essBulk: values.map((value) => 1000 - value),
    essTail: values,
    mcseMean: values,
    mcseSd: values,
    autocorrelation: values,
  });
  const both = { a: list([1, 7, 3]), b: list([2, 5, 9]) };
  assert.deepEqual(words.worstMode(both, "rHat"), { mode: 3, side: "b", value: 1.009 });
  assert.deepEqual(words.worstMode(both, "essBulk"), { mode: 3, side: "b", value: 991 });
  assert.deepEqual(words.worstMode(both, "essTail"), { mode: 1, side: "a", value: 1 });
});

test("modes that are not determined one by one are named together", () => {
  assert.deepEqual(words.unsettledModes([0.1, 0.3, 0.5, 0.1, 0.9]), [[2, 3], [5]]);
  const said = (modeTurns: number[]) => {
    const { accuracy } = report.intersection;
    return words.unsettled(
      withIntersection({ accuracy: accuracy ? { ...accuracy, modeTurns } : null }),
    );
  };
  assert.equal(said([0.1, 0.2]), null);
  assert.equal(
    said([0, 0, 0, 0.4, 0.4]),
    "Modes 4 and 5 have nearly equal variance: only the two together are determined.",
  );
  assert.match(
    said([0.4, 0.4, 0.4, 0, 0.4]) ?? "",
    /^Modes 1 to 3 .* The same holds for mode 5\.$/,
  );
  assert.match(said([0, 0.4]) ?? "", /^Mode 2 is not determined well/);
});

test("sides that differ much are said to describe different shapes", () => {
  const { disagreement } = report.intersection;
  const said = (covariance: number) => {
    const found = withIntersection({
      disagreement: disagreement ? { ...disagreement, covariance } : null,
    });
    return plain(words.twoSides(found) ?? []);
  };
  assert.match(said(0.62), /describe different sets of shapes/);
  assert.doesNotMatch(said(0.2), /different sets/);
});

test("the paper's difference is said to be the model where it is, and only that one", () => {
  const at = (a: number, b: number, difference: "soft" | "relative" = "soft") => {
    const { aWithoutB, bWithoutA } = report.differences;
    const found = words.nearlyTheModel({
      ...report,
      settings: { ...report.settings, difference },
      differences: {
        aWithoutB: { ...aWithoutB, overlapWithPrior: a },
        bWithoutA: { ...bWithoutA, overlapWithPrior: b },
      },
    });
    return found && plain(found);
  };
  assert.match(
    at(0.97, 0.96) ?? "",
    /nearly all of each model: 97\u202f% like A, 96\u202f% like B\.$/,
  );
  assert.match(at(0.97, 0.5) ?? "", /nearly all of A: 97\u202f% like it\.$/);
  assert.equal(at(0.8, 0.9), null);
  assert.equal(at(1, 1, "relative"), null);
});

test("a hard difference is told by its own definition", () => {
  const said = (difference: "distance" | "relative" | "outside") => {
    const hard = madeUpReport({ difference });
    return plain(words.differences(hard, nouns));
  };
  for (const name of ["distance", "relative", "outside"] as const) {
    assert.match(said(name), /20\u202f% of male heads and 20\u202f% of female heads/);
    assert.doesNotMatch(said(name), /σ/);
  }
  assert.equal(new Set((["distance", "relative", "outside"] as const).map(said)).size, 3);
});

test("while a file is read it is said how far, in the unit of the whole", () => {
  assert.equal(words.readingSentence(null), "Opening…");
  const reading = (bytes: number, of: number) => words.readingSentence({ bytes, of });
  assert.equal(reading(120e6, 317e6), "Reading 120 of 317\u202fMB");
  assert.equal(reading(2000, 30_000), "Reading 2 of 30\u202fkB");
  assert.equal(reading(317e6, 317e6), "Computing the model…");
});

test("a model that was made here says from what", () => {
  assert.equal(words.originSentence({ kind: "file" }), null);
  const shapes = { kind: "shapes", count: 24, scaled: false } as const;
  assert.equal(words.originSentence(shapes), "Computed here from 24 shapes, aligned rigidly.");
  assert.match(words.originSentence({ ...shapes, scaled: true }) ?? "", /scaled to one size/);
});

test("shapes that are known with a model are said with what they are", () => {
  const known = { count: 20, role: "training", name: null, fingerprint: null } as const;
  assert.equal(words.shapesSentence(known), "20 training shapes.");
  const beside = { ...known, role: "test", name: "males" } as const;
  assert.equal(words.shapesSentence(beside), "20 test shapes, of “males”.");
  const within = { ...known, role: "within-modes" } as const;
  assert.match(words.shapesSentence(within), /^20 training shapes, known only within the modes/);
});

test("what a file leaves open is told, what is in order is not", () => {
  const { a } = report.models;
  assert.equal(words.unitSentence({ ...a, unit: "mm" }), null);
  assert.equal(words.unitSentence({ ...a, unit: "units" }), "Unit not stated.");
  const guessed: ModelReport = { ...a, unit: "units", unitGuess: "mm" };
  assert.equal(words.unitSentence(guessed), "Unit not stated, probably mm.");
  assert.equal(words.basisSentence(a), null);
  assert.equal(words.basisSentence({ ...a, orthogonality: 1e-7, droppedModes: 0 }), null);
  assert.equal(
    words.basisSentence({ ...a, orthogonality: 0.02, droppedModes: 1 }),
    "Basis was not orthonormal (off by 0.020); corrected. 1 mode without variance left out.",
  );
});

test("a pair that can be compared is one line", () => {
  const found: Inspection = {
    problem: null,
    points: { a: 5023, b: 5023 },
    compared: 5023,
    triangles: "same",
    units: { a: { stated: "mm", guess: null }, b: { stated: "mm", guess: null } },
    meanDistance: { before: 1.4, now: 1.4, rigid: 0.9, similarity: null, mirrored: null },
    scale: 1,
    remedies: [],
    applied: [],
  };
  const line = (change: Partial<Inspection>) => words.pairLine({ ...found, ...change }, "mm");
  assert.equal(line({}), "5023 points in common · same faces · means 1.40\u202fmm apart");
  assert.match(line({ compared: 900 }), /^900 points compared · /);
  const meanDistance = { before: null, now: null, rigid: null, similarity: null, mirrored: null };
  const unlike = { points: { a: 5023, b: 900 }, compared: null, meanDistance };
  assert.equal(line({ ...unlike, triangles: "unknown" }), "5023 and 900 points");
  assert.equal(
    words.alignmentWords(found, "mm"),
    "1.40\u202fmm apart as they stand, 0.900\u202fmm aligned rigidly",
  );
});

test("the settings of a comparison say what was done to the models", () => {
  const prepare = { ...completed(null), points: { by: "region" as const, ranges: "0-9" } };
  const { settings } = report;
  assert.match(
    words.settingsSentence({ ...report, settings: { ...settings, prepare } }),
    / · a region of 10 points$/,
  );
});

test("a link without σ may have meant another one, unless the rule is the older one", () => {
  const of = (sigmaSource: Report["sigmaSource"]) => words.olderSigma({ ...report, sigmaSource });
  assert.match(
    of("meeting")?.message ?? "",
    /^This link may be from a version before 0\.2, .* now gives σ = 0\.613.units, the least distance of plausible/,
  );
  assert.ok(of("left-out") && of("noise"), "new rules");
  assert.deepEqual([of("budget"), of("given")], [null, null], "as before");
});
