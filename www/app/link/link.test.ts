import assert from "node:assert/strict";
import { test } from "node:test";
import type { Preparation } from "../../worker/protocol";
import { FIRST_DEMO } from "../state/demos";
import {
  defaultLink,
  fitsLink,
  mayMeanAnotherSigma,
  readLink,
  SETTING_KEYS,
  writeLink,
} from "./link";
import { readKeys } from "./reading";

/** The keys that cannot be used. */
const misread = (link: string) => readKeys(link).faults.map(({ key }) => key);

test("an empty link is the first comparison, with the σ that it is stored with", () => {
  const { settings, ...rest } = defaultLink();
  const expected = { ...rest, settings: { ...settings, sigma: FIRST_DEMO.sigma } };
  assert.deepEqual(readLink(""), expected);
  assert.deepEqual(readLink("v=1&demo=heads-sex&view=contrast"), expected);
  assert.equal(readLink("v=1&seed=1").settings.sigma, null, "who sets one thing leaves σ open");
  assert.equal(readLink("v=1&demo=planes").settings.sigma, null, "so do other examples");
});

test("what is written is read back, for every field", () => {
  const state = defaultLink();
  const other = {
    ...state,
    demo: "stars-3",
    settings: {
      ...state.settings,
      sigma: 0.25,
      seed: "18446744073709551615",
      sampler: "paper-corrected" as const,
      chains: 25,
      draws: 2500,
      burnIn: 2000,
      thin: 30,
      modes: 12,
      align: "rigid" as const,
      fit: "laplace" as const,
      pooling: "b" as const,
      plausibility: "idempotent" as const,
      noise: 0.35,
      weighted: 20_000,
      difference: "outside" as const,
      differenceQuantile: 0.953,
      differenceThreshold: 3.5,
      differenceDraws: 64,
      prepare: {
        a: { unit: "mm" as const, modes: 12, variance: null, rebase: false },
        b: { unit: "µm" as const, modes: null, variance: 0.95, rebase: true },
        convert: true,
        mirror: true,
        points: { by: "region" as const, ranges: "0-99,120,130-140" },
        subsample: 2000,
      },
    },
    parts: { a: null, b: null },
    view: "sd" as const,
    tab: "diagnostics" as const,
    side: "b" as const,
    coefficient: 11,
    map: "mode" as const,
    mapMode: 3,
    vertex: 0,
    scale: [-2.5, 2.5] as [number, number],
    heatScale: 0.125,
    region: "aWithoutB" as const,
    picture: "exclusiveModes" as const,
    exaggeration: 2.5,
    shapes: "7",
    rank: 95,
    modelList: ["heads-male", "stars-1-a", "planes-b"],
    measure: "grassmann-affine" as const,
    camera: { yaw: -1.25, pitch: 0.5, zoom: 2, x: 0.25, y: -0.5 },
  };
  assert.deepEqual(readLink(`#${writeLink(state)}`), state);
  assert.deepEqual(readLink(`#${writeLink(other)}`), other);
});

test("a link begins with its version, is short and can be read", () => {
  const text = writeLink(defaultLink());
  assert.match(text, /^v=1&engine=0.2&demo=heads-sex&/);
  assert.ok(text.length < 300, `${text.length} characters`);
  assert.doesNotMatch(text, /%/);
});

test("only a link without σ from before the rule may mean another one", () => {
  const cases = {
    // As older pages wrote it, and by hand.
    "v=1&demo=planes&sigma=auto": true,
    "#v=1&demo=planes": true,
    "v=1&engine=0.1&demo=planes": true,
    "v=1&engine=x&demo=heads-sex&seed=1": true,
    "v=1&engine=0.2&demo=planes": false,
    "v=1&engine=0.10.1&demo=planes": false,
    "v=1&engine=1.0&demo=planes": false,
    "v=1&demo=planes&sigma=0.5": false,
    "v=1&page=learn&scene=step": false,
    // The stored comparison has a σ.
    "v=1": false,
    "": false,
    [writeLink(defaultLink())]: false,
  };
  for (const [text, expected] of Object.entries(cases)) {
    assert.equal(mayMeanAnotherSigma(text), expected, text);
  }
});

test("a link of the page before there were maps shows standard deviations, on their own scale", () => {
  const link = readLink("v=1&demo=stars-1&view=sd");
  assert.deepEqual([link.view, link.map, link.vertex, link.scale], ["sd", "sd", null, null]);
});

test("a scale that is none is passed over", () => {
  for (const text of ["2,1", "1", "1,2,3", "a,b", "0,Infinity"]) {
    assert.equal(readLink(`v=1&scale=${text}`).scale, null, text);
  }
});

test("addresses of models keep their queries", () => {
  const urls = { a: "https://a.example/m.h5?x=1&y=2#part", b: "https://b.example/n+o.npz" };
  const link = { ...defaultLink(), urls };
  assert.deepEqual(readLink(writeLink(link)).urls, urls);
});

test("two models of different examples, or of one and an address, have a link too", () => {
  const urls = { a: "demo:heads-male", b: "https://b.example/m.npz" };
  const text = writeLink({ ...defaultLink(), urls });
  assert.match(text, /^v=1&engine=0.2&a=demo:heads-male&b=https:/);
  assert.deepEqual(readLink(text).urls, urls);
  assert.equal(readLink("v=1&a=demo:heads-male&b=demo:nobody").urls, null);
});

test("a model list holds the page's own models, each once, and nothing that there is not", () => {
  const { modelList } = readLink("v=1&shelf=heads-male,heads-male,planes-a");
  assert.deepEqual(modelList, ["heads-male", "planes-a"]);
  assert.deepEqual(misread("v=1&shelf=heads-male,nobody"), ["shelf"]);
  assert.deepEqual(readLink("v=1&demo=planes").modelList, [], "older links have none");
});

test("parts of the files at two addresses are kept", () => {
  const urls = { a: "https://a.example/m.h5", b: "https://a.example/m.h5" };
  const link = { ...defaultLink(), urls, parts: { a: null, b: "expression" } };
  const text = writeLink(link);
  assert.match(text, /&part-b=expression&/);
  assert.deepEqual(readLink(text), link);
});

test("what is done to the models first can be read in the link, and a list is left out", () => {
  const { settings } = defaultLink();
  const written = (prepare: Partial<Preparation>) =>
    writeLink({
      ...defaultLink(),
      settings: { ...settings, prepare: { ...settings.prepare, ...prepare } },
    });
  assert.match(
    written({ points: { by: "region", ranges: "0-99,120" }, subsample: 500 }),
    /&points=0-99,120&subsample=500&/,
  );
  assert.match(written({ points: { by: "map" } }), /&points=map&/);
  const list = written({ points: { by: "list", a: [1, 2], b: [3, 4] } });
  assert.equal(list, writeLink(defaultLink()));
  // Longer ones are cut by the programs that pass links on.
  const frayed = Array.from({ length: 900 }, (_, i) => 3 * i).join(",");
  assert.equal(written({ points: { by: "region", ranges: frayed } }), list);
  assert.equal(fitsLink({ by: "region", ranges: frayed }), false);
  assert.equal(fitsLink({ by: "map" }), true);
  assert.equal(fitsLink(null), true);
});

test("only web addresses are opened, and what is none is told", () => {
  const odd = "v=1&a=javascript:alert(1)&b=file:///etc/passwd";
  assert.equal(readLink(odd).urls, null);
  assert.deepEqual(misread(odd), ["a", "b"]);
  assert.deepEqual(misread("v=1&a=demo:nobody&b=demo:planes-a"), ["a"]);
  assert.deepEqual(misread("v=1&a=models/m.h5&b=demo:planes-a"), []);
});

test("files that no link can hold are named by what tells them from others", () => {
  const hashes = { a: "0123456789abcdef", b: "fedcba9876543210" };
  const names = { a: "male head.h5", b: "b&w.npz" };
  const urls = { a: null, b: null };
  const link = { ...defaultLink(), urls, names, hashes, parts: { a: "expression", b: null } };
  const text = writeLink(link);
  assert.match(
    text,
    /^v=1&engine=0.2&name-a=male%20head\.h5&name-b=b%26w\.npz&hash-a=0123456789abcdef&/,
  );
  assert.deepEqual(readLink(text), link);
  const nameless = { ...link, names: { a: null, b: null } };
  assert.deepEqual(readLink(writeLink(nameless)), nameless);
  const mixed = { ...link, urls: { a: "demo:planes-a", b: null }, names: { a: null, b: "b.h5" } };
  assert.deepEqual(readLink(writeLink(mixed)), mixed);
  // Of one model nothing is said: nobody knows what is meant.
  assert.equal(readLink("v=1&name-a=male.h5").urls, null);
  assert.equal(readLink("v=1&name-a=male.h5&hash-b=xyz").urls, null);
});

test("what is at an address is told by the start of its fingerprint, however much is given", () => {
  const link = (hash: string) => `v=1&a=https://a.example/m.h5&b=demo:planes-b&hash-a=${hash}`;
  const read = (hash: string) => readLink(link(hash)).hashes.a;
  assert.equal(read("0123456789ABCDEF0123456789abcdef"), "0123456789abcdef");
  assert.equal(read("01234567"), "01234567");
  assert.equal(read("0123"), null);
  assert.equal(read("unknown!"), null);
});

test("a frame says so, and an older link is none", () => {
  assert.equal(readLink(writeLink({ ...defaultLink(), embed: true })).embed, true);
  assert.equal(readLink("v=1&demo=planes").embed, false);
  assert.equal(readLink("v=1&embed=no").embed, false);
});

test("unknown keys and unreadable values are passed over", () => {
  const odd =
    "v=9&demo=nothing&sigma=-3&seed=abc&chains=0&draws=1&view=xray&region=c&camera=a,b&z=1&measure=love" +
    "&unit-a=ell&modes-b=0&variance-a=120&rebase=c&convert=1&points=9-3&subsample=2";
  assert.deepEqual(readLink(odd), defaultLink());
});

test("a sampler without a budget gets its own", () => {
  const { settings } = readLink("v=1&sampler=paper");
  assert.equal(settings.chains, 25);
  assert.equal(settings.burnIn, 2000);
});

test("every setting that differs from the default is in the link, under a key of a setting", () => {
  const { settings } = defaultLink();
  const other = {
    ...settings,
    fit: "rms" as const,
    pooling: "a" as const,
    plausibility: "idempotent" as const,
    noise: 1,
    weighted: 2048,
    difference: "distance" as const,
    differenceQuantile: 0.5,
    differenceThreshold: 1,
    differenceDraws: 100,
    prepare: {
      a: { unit: "m" as const, modes: 3, variance: 0.9, rebase: true },
      b: { unit: "cm" as const, modes: 3, variance: 0.9, rebase: true },
      convert: true,
      mirror: false,
      points: { by: "map" as const },
      subsample: 100,
    },
  };
  const keys = (link: string) => [...new URLSearchParams(link).keys()];
  const plain = keys(writeLink(defaultLink()));
  const added = keys(writeLink({ ...defaultLink(), settings: other })).filter(
    (key) => !plain.includes(key),
  );
  assert.equal(added.length, 9 + 10);
  for (const key of added) assert.ok(SETTING_KEYS.includes(key), key);
});

test("a link of the first version opens as it did", () => {
  const old =
    "v=1&demo=stars-1&align=none&modes=all&sigma=0.2&sampler=independence&seed=7&chains=8&draws=4000&burnin=10&thin=1&view=mean";
  const { settings } = readLink(old);
  assert.deepEqual(settings, {
    ...defaultLink().settings,
    sampler: "independence",
    sigma: 0.2,
    seed: "7",
  });
  assert.deepEqual(misread(old), []);
});

test("what a link asks for and nobody knows falls back, and is told", () => {
  const newer =
    "v=2&demo=stars-1&sampler=nuts&diff=fuzzy&sides=c&leaves=120&noise=-1&exaggerate=9&unit-b=inch";
  assert.deepEqual(readLink(newer), { ...defaultLink(), demo: "stars-1" });
  assert.deepEqual(misread(newer), [
    "v",
    "sampler",
    "diff",
    "sides",
    "leaves",
    "noise",
    "exaggerate",
    "unit-b",
  ]);
});
