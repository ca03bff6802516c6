import assert from "node:assert/strict";
import { test } from "node:test";
import { defaultLink, readLink, writeLink } from "../../www/app/link";

test("an empty link is the first comparison", () => {
  assert.deepEqual(readLink(""), defaultLink());
  assert.deepEqual(readLink("#"), defaultLink());
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
    },
    view: "sd" as const,
    region: "aWithoutB" as const,
    shapes: "7",
    camera: { yaw: -1.25, pitch: 0.5, zoom: 2, x: 0.25, y: -0.5 },
  };
  assert.deepEqual(readLink(`#${writeLink(state)}`), state);
  assert.deepEqual(readLink(`#${writeLink(other)}`), other);
});

test("a link begins with its version, is short and can be read", () => {
  const text = writeLink(defaultLink());
  assert.match(text, /^v=1&demo=heads-sex&/);
  assert.ok(text.length < 300, `${text.length} characters`);
  assert.doesNotMatch(text, /%/);
});

test("addresses of models keep their queries", () => {
  const urls = { a: "https://a.example/m.h5?x=1&y=2#part", b: "https://b.example/n+o.npz" };
  const link = { ...defaultLink(), urls };
  assert.deepEqual(readLink(writeLink(link)).urls, urls);
});

test("only web addresses are opened", () => {
  assert.equal(readLink("v=1&a=javascript:alert(1)&b=file:///etc/passwd").urls, null);
});

test("unknown keys and unreadable values are passed over", () => {
  const odd =
    "v=9&demo=nothing&sigma=-3&seed=abc&chains=0&draws=1&view=xray&region=c&camera=a,b&z=1";
  assert.deepEqual(readLink(odd), defaultLink());
});

test("a sampler without a budget gets its own", () => {
  const { settings } = readLink("v=1&sampler=paper");
  assert.equal(settings.chains, 25);
  assert.equal(settings.burnIn, 2000);
});
