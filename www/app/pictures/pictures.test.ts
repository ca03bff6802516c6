import assert from "node:assert/strict";
import { test } from "node:test";
import { crc32 } from "node:zlib";
import type { Settings } from "../../worker/protocol";
import { madeUpReport } from "../comparison/report.fixture";
import { captionOf, type Shown } from "./caption";
import {
  blend,
  FIRST_FILM,
  type FilmOptions,
  filmSentence,
  frameCount,
  labelAt,
  momentOf,
  positionAt,
} from "./film";
import { layoutFigure, UNITS_PER_INCH, widthInPixels, wrapped } from "./layout";
import { withResolution } from "./png";

const reportWith = (settings: Partial<Settings>) =>
  madeUpReport(settings, { a: "stars-1-a", b: "stars-1-b" });

const shown: Shown = {
  shows: "shapes",
  map: "Standard deviation per vertex, mm",
  shapes: 9,
  overlaid: false,
  contrast: "",
  differences: "",
  vertex: null,
};

test("a caption says models, σ, seed and what is shown", () => {
  const report = reportWith({ sigma: 0.3, seed: "7", align: "rigid" });
  const text = captionOf(shown, report);
  assert.match(text, /^Random shapes of A, A∖B, A∩B, B∖A and B, 9 of each, side by side\./);
  assert.match(text, /A: stars-1-a \(120 points, 3 modes\); B: stars-1-b/);
  assert.match(text, /σ 0\.300\u202funits, seed 7, rigidly aligned; Shapevenn of a test\.$/);
  const vertex = { number: 5, deviations: 2, dimension: 2 as const };
  assert.doesNotMatch(captionOf({ ...shown, vertex }, report), /Ellipse/);
  const map = captionOf({ ...shown, shows: "variance", vertex, differences: "γ 1.0" }, report);
  assert.match(map, /^Standard deviation per vertex, mm, on the mean shapes of A/);
  assert.match(map, /Of A∖B and B∖A: γ 1\.0\. Ellipses: covariance of vertex 5 at 2 SD\./);
  assert.match(captionOf({ ...shown, overlaid: true, shapes: 60 }, report), /60 of each, overlaid/);
});

test("the caption of a contrast says what was pushed and what the colour is, and has no ellipsoid", () => {
  const report = reportWith({ sigma: 0.3 });
  const contrast =
    "A, B and A∩B are means. A∖B: the mean of A, its distance from B drawn 3.0 times as large.";
  const vertex = { number: 5, deviations: 2, dimension: 3 as const };
  const map = "Mean distance to the nearest shape of the other model, mm";
  const of = (part: Partial<Shown>) =>
    captionOf({ ...shown, shows: "contrast", map, vertex, ...part }, report);
  assert.ok(
    of({ contrast }).startsWith(
      `${contrast} Colours: mean distance to the nearest shape of the other model, mm. A: stars-1-a`,
    ),
    of({ contrast }),
  );
  assert.match(of({}), /^Mean shapes of A, A∩B and B\. A: stars-1-a/);
});

test("a figure is as wide as asked for, in pixels or in print", () => {
  assert.equal(widthInPixels({ width: 1234, unit: "px", dpi: 300 }), 1234);
  assert.equal(widthInPixels({ width: 254, unit: "mm", dpi: 300 }), 3000);
});

test("its five blocks are alike, side by side in the paper's order, and nothing overlaps", () => {
  const frame = { centre: [0, 0, 0] as [number, number, number], halfWidth: 1, halfHeight: 1.25 };
  const em = (8 / 72) * UNITS_PER_INCH;
  const parts = { em, cells: 9, labels: true, bar: true, captionLines: 2 };
  const layout = layoutFigure(1000, frame, parts);
  const blocks = [...layout.blocks];
  assert.deepEqual(
    blocks.map(([region]) => region),
    ["a", "aWithoutB", "intersection", "bWithoutA", "b"],
  );
  let right = 0;
  for (const [, { x, y, width, height }] of blocks) {
    assert.ok(x >= right && y > layout.labels && y + height < layout.bar);
    assert.ok(Math.abs(height / width - 1.25) < 1e-9, "a grid of cells as the shapes are");
    right = x + width;
  }
  assert.ok(right < 1000 && layout.bar < layout.caption && layout.caption + 2 * em < layout.height);
  const bare = layoutFigure(1000, frame, { ...parts, labels: false, bar: false, captionLines: 0 });
  assert.ok(bare.height < layout.height - 5 * em);
});

test("captions are wrapped between words", () => {
  const lines = wrapped("one two three four", 8, (text) => text.length);
  assert.deepEqual(lines, ["one two", "three", "four"]);
  assert.deepEqual(
    wrapped("", 8, (text) => text.length),
    [],
  );
});

test("a PNG says how large it is printed, in a chunk whose checksum is right", () => {
  const png = new Uint8Array(60).map((_, i) => i);
  const whole = withResolution(png, 300);
  assert.deepEqual(whole.subarray(0, 33), png.subarray(0, 33));
  assert.deepEqual(whole.subarray(54), png.subarray(33));
  const view = new DataView(whole.buffer);
  assert.equal(Buffer.from(whole.subarray(37, 41)).toString(), "pHYs");
  assert.equal(view.getUint32(41), 11811);
  assert.equal(view.getUint32(50), crc32(whole.subarray(37, 50)));
});

const film = (part: Partial<FilmOptions>): FilmOptions => ({ ...FIRST_FILM, ...part });

test("a mode swings from −3 to 3 SD and back; without a loop it ends there", () => {
  assert.equal(positionAt(film({}), 0), -3);
  assert.equal(positionAt(film({}), 0.5), 3);
  assert.equal(positionAt(film({}), 1), -3);
  assert.equal(positionAt(film({ loops: false }), 1), 3);
  const morph = film({ subject: "morph" });
  assert.deepEqual(
    [0, 0.5, 1].map((t) => positionAt(morph, t)),
    [0, 2, 0],
  );
});

test("a film that loops does not show its first frame twice, another ends on its last moment", () => {
  const frames = frameCount(film({ seconds: 2 }));
  assert.equal(frames, 50);
  assert.ok(momentOf(film({ seconds: 2 }), frames - 1) < 1);
  assert.equal(momentOf(film({ seconds: 2, loops: false }), frames - 1), 1);
});

test("between its shapes a film mixes them, beyond them it stays", () => {
  const key = (at: number, value: number) => ({
    at,
    shape: Float32Array.from([value, -value]),
    tint: [value, 0, 0] as const,
  });
  const keys = [key(0, 0), key(1, 10), key(2, 40)];
  const at = (position: number) => [...(blend(keys, position)?.shape ?? [])];
  assert.deepEqual(at(0.5), [5, -5]);
  assert.deepEqual(at(1), [10, -10]);
  assert.deepEqual(at(1.5), [25, -25]);
  assert.deepEqual(
    [at(-1), at(3)],
    [
      [0, -0],
      [40, -40],
    ],
  );
  assert.deepEqual(blend(keys, 1.5)?.tint, [25, 0, 0]);
});

test("a film says what it is and where it is", () => {
  const report = reportWith({});
  assert.equal(labelAt(film({ mode: 1 }), 1.52), "A∩B, mode 2: +1.5 SD");
  assert.equal(labelAt(film({ subject: "morph" }), 1.5), "A∩B → B, 50\u202f%");
  assert.equal(labelAt(film({ subject: "morph" }), 0), "A");
  assert.match(
    filmSentence(film({ subject: "a" }), report),
    /^Mode 1 of A \(stars-1-a\), −3 to \+3 SD and back/,
  );
});
