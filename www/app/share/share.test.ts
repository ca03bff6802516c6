/** Tests the texts of sharing. That the command computes the same is tested in the browser. */
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Settings } from "../../worker/protocol";
import { DEFAULTS } from "../state/settings";
import { commandOf } from "./command";
import { holdsSentences } from "./holds";
import { qrCode } from "./qr";
import { elementSnippet, frameSnippet } from "./snippets";

const model = (source: string, part: string | null = null, reading = "") => ({
  source,
  part,
  reading,
});
const heads = { a: model("demo:heads-male"), b: model("demo:heads-female") };
const line = (settings: Partial<Settings>, models = heads) =>
  commandOf({ ...DEFAULTS, ...settings }, models).line;

test("a command says what is other than by default, and nothing else", () => {
  assert.equal(line({}), "shapevenn compare demo:heads-male demo:heads-female");
  assert.equal(line({ sigma: 1 }), `${line({})} --sigma 1`);
  const walk = { sampler: "paper", chains: 25, draws: 2500, burnIn: 2000, thin: 30 } as const;
  assert.equal(line(walk), `${line({})} --sampler paper`, "its own budget is its default");
  assert.equal(line({ ...walk, thin: 10 }), `${line({})} --sampler paper --thin 10`);
});

test("file names are quoted for a shell, parts follow them", () => {
  const models = { a: model("my model's.h5", "expression"), b: model("b.h5", "shape") };
  assert.equal(line({}, models), "shapevenn compare 'my model'\\''s.h5#expression' 'b.h5#shape'");
});

test("shapes beside a model are a flag", () => {
  const models = { a: { ...model("a.h5"), shapes: "my males" }, b: model("b.h5") };
  assert.equal(line({}, models), "shapevenn compare a.h5 b.h5 --training-a 'my males'");
});

test("steps before the comparison are flags; what there is no flag for is told", () => {
  const { prepare } = DEFAULTS;
  const prepared = (part: Partial<Settings["prepare"]>, models = heads) =>
    commandOf({ ...DEFAULTS, prepare: { ...prepare, ...part } }, models);
  const side = prepare.a;
  const both = prepared({
    a: { ...side, unit: "mm", variance: 0.9, rebase: true },
    b: { ...side, unit: "µm", variance: 0.9 },
    convert: true,
    points: { by: "region", ranges: "0-99,120" },
    subsample: 50,
  });
  assert.deepEqual(both.missing, []);
  assert.equal(
    both.line.slice(line({}).length),
    " --unit-a mm --unit-b 'µm' --convert-units --variance 0.9 --rebase a --region 0-99,120 --subsample 50",
  );
  const list = { by: "list" as const, a: [1], b: [1] };
  assert.equal(prepared({ a: { ...side, modes: 3 }, points: list }).missing.length, 2);
  assert.equal(prepared({ a: { ...side, variance: 0.9 } }).missing.length, 1);
  const rebased = { ...side, rebase: true };
  assert.equal(prepared({ a: rebased, b: rebased }).missing.length, 1);
  const sized = { a: model("a", null, "scale"), b: model("b", null, "scale") };
  assert.match(prepared({}, sized).line, /--read scale$/);
  assert.match(prepared({}, { ...sized, b: model("b") }).line, /--read-a scale$/);
  const mirrored = { a: model("a", null, "missing=points mirror=3"), b: model("b") };
  assert.match(prepared({}, mirrored).line, /--read-a 'missing=points mirror=3'$/);
});

test("what a link holds is said for files, for more models and for lists of points", () => {
  const none = { files: [], modelList: false, shapes: false, points: false };
  assert.match(holdsSentences(none).join(" "), /^The link contains the models, all settings/);
  assert.equal(
    holdsSentences({ ...none, files: ["a", "b"] })[0],
    "The link contains all settings and the fingerprints of your two files, not the files. To open it, drop the same files; the page checks that they are the same.",
  );
  assert.match(holdsSentences({ ...none, files: ["b"] })[0] ?? "", /fingerprint of your file, B/);
  const all = { files: [], modelList: true, shapes: true, points: true };
  assert.equal(holdsSentences(all).length, 4);
  assert.match(holdsSentences(all)[1] ?? "", /^The shapes that were added to the models are not/);
});

test("snippets are escaped, and without scripts a link stays", () => {
  const address = "https://a.example/venn/#v=1&demo=planes";
  const element = elementSnippet(address, 'A "and" B');
  assert.match(element, /src="https:\/\/a\.example\/venn\/shape-venn\.js"/);
  assert.match(element, /title="A &quot;and&quot; B" link="v=1&amp;demo=planes"/);
  assert.match(element, /<a href="https:\/\/a\.example\/venn\/#v=1&amp;demo=planes">/);
  assert.match(frameSnippet(address, "x"), /^<iframe src="[^"<>]+" title="x" [^<>]+><\/iframe>$/);
});

test("a code has a white rim of four modules", () => {
  const { size, path } = qrCode("https://a.example/");
  const starts = [...path.matchAll(/M(\d+) (\d+)h(\d+)/g)].map((found) =>
    found.slice(1).map(Number),
  );
  const [xs, ys, ends] = [0, 1, 2].map((i) =>
    starts.map(([x = 0, y = 0, length = 0]) => [x, y, x + length][i] ?? 0),
  ) as [number[], number[], number[]];
  assert.equal(Math.min(...xs, ...ys), 4);
  assert.equal(Math.max(...ends, ...ys.map((y) => y + 1)), size - 4);
});
