import assert from "node:assert/strict";
import { test } from "node:test";
import { MAPS } from "../state/view";
import {
  colourOf,
  commonRange,
  gradientOf,
  type Rgb,
  rangeBelow,
  symmetricRange,
} from "../text/colormap";
import { signed, withoutRoundingError } from "../text/format";
import { contentsOf, type Scene } from "../viewer/contents";
import { semiAxes } from "./ellipsoid";
import { MAP_WORDS, mapCaption, mapUnit, scaleEnds } from "./map-words";

type Triple = [number, number, number];

const linear = (colour: Rgb) =>
  colour.map((value) => {
    const share = value / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  }) as Triple;

/** CIELAB of a colour in linear light, under D65. */
function labOf([r, g, b]: Triple): Triple {
  const [x, y, z] = [
    (0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047,
    0.2126729 * r + 0.7151522 * g + 0.072175 * b,
    (0.0193339 * r + 0.119192 * g + 0.9503041 * b) / 1.08883,
  ].map((t) => (t > 0.008856 ? Math.cbrt(t) : 7.787 * t + 16 / 116)) as Triple;
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

const lightness = (colour: Rgb) => labOf(linear(colour))[0];

/** As people see it who lack one of the three cones: Machado, Oliveira & Fernandes (2009), severity 1. */
const LACKING: Record<string, Triple[]> = {
  protan: [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  deutan: [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  tritan: [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
};

function seen(colour: Rgb, matrix: Triple[]): Triple {
  const [r, g, b] = linear(colour);
  return matrix.map(([x, y, z]) => Math.max(0, x * r + y * g + z * b)) as Triple;
}

test("both sides of the signed scale are equally light, darker outwards, and grey in the middle", () => {
  for (let share = 0; share <= 0.5; share += 0.02) {
    const [low, high] = [
      lightness(colourOf("diverging", share)),
      lightness(colourOf("diverging", 1 - share)),
    ];
    assert.ok(Math.abs(low - high) < 1.2, `${share}: ${low} and ${high}`);
    if (share >= 0.02)
      assert.ok(low > lightness(colourOf("diverging", share - 0.02)), String(share));
  }
  assert.deepEqual(colourOf("diverging", 0.5), [221, 221, 221]);
});

test("what is missed goes from light to dark in equal steps, and p-values from dark to light", () => {
  const steps = Array.from({ length: 9 }, (_, i) => lightness(colourOf("magma", i / 8)));
  const falls = steps.slice(1).map((light, i) => (steps[i] ?? 0) - light);
  for (const fall of falls) assert.ok(fall > 6 && fall < 13, `${falls}`);
  for (const share of [0, 0.25, 1]) {
    assert.deepEqual(colourOf("magma-reversed", share), colourOf("magma", 1 - share));
  }
  // Lightness alone tells them apart, also for people who lack a cone.
  for (const [name, matrix] of Object.entries(LACKING)) {
    const seenSteps = [0, 0.5, 1].map((share) => labOf(seen(colourOf("magma", share), matrix))[0]);
    assert.ok((seenSteps[0] ?? 0) > (seenSteps[1] ?? 0) + 20, name);
    assert.ok((seenSteps[1] ?? 0) > (seenSteps[2] ?? 0) + 20, name);
  }
});

test("a scale that begins at 0 leaves out the largest values", () => {
  const maps = [Float32Array.from([1, 2, 3, Number.NaN]), Float32Array.from([4, 100])];
  assert.deepEqual(rangeBelow(maps, 0.75), [0, 4]);
  assert.equal(rangeBelow([], 0.9), null);
});

test("the end that stands for A is blue, that for B orange", () => {
  const [orange, blue] = [colourOf("diverging", 0), colourOf("diverging", 1)];
  assert.ok(orange[0] > orange[1] && orange[1] > orange[2]);
  assert.ok(blue[2] > blue[1] && blue[1] > blue[0]);
});

test("its ends and its middle stay apart for people who lack a cone", () => {
  for (const [name, matrix] of Object.entries(LACKING)) {
    const lab = [0, 0.5, 1].map((share) => labOf(seen(colourOf("diverging", share), matrix)));
    for (const [i, k] of [
      [0, 1],
      [1, 2],
      [0, 2],
    ] as const) {
      const [one, other] = [lab[i] as Triple, lab[k] as Triple];
      const apart = Math.hypot(...one.map((value, axis) => value - (other[axis] ?? 0)));
      assert.ok(apart > 35, `${name}: ${i} and ${k} are ${apart} apart`);
    }
  }
});

test("what is beyond a range has the colour of its end, what is no number one of its own", () => {
  assert.deepEqual(colourOf("viridis", -3), colourOf("viridis", 0));
  assert.deepEqual(colourOf("diverging", 7), colourOf("diverging", 1));
  assert.notDeepEqual(colourOf("viridis", Number.NaN), colourOf("viridis", 0));
  assert.match(gradientOf("diverging"), /^linear-gradient\(to right, rgb\(156 77 5\)/);
});

test("a range of signed numbers has 0 in its middle, and infinities do not widen any", () => {
  const maps = [Float32Array.from([-0.5, 2]), Float32Array.from([1, Number.NEGATIVE_INFINITY])];
  assert.deepEqual(symmetricRange(maps), [-2, 2]);
  assert.deepEqual(commonRange(maps), [-0.5, 2]);
  assert.equal(symmetricRange([]), null);
});

test("every map says what it is with its unit, and signed ones which end is which", () => {
  for (const name of MAPS) {
    const caption = mapCaption(name, { mode: 4, signed: true }, "mm");
    assert.ok(caption.endsWith(`, ${mapUnit(name, "mm")}`), caption);
    assert.ok(MAP_WORDS[name].help.length > 20);
    assert.equal(scaleEnds(name, false), null);
  }
  assert.equal(mapUnit("ratio", "mm"), "log₂");
  assert.match(
    mapCaption("mode", { mode: 4, signed: true }, "mm"),
    /mode 5, along the normal, mm$/,
  );
  // Without a normal there is only a size.
  assert.doesNotMatch(mapCaption("means", { mode: 0, signed: false }, "mm"), /normal/);
  assert.deepEqual(scaleEnds("ratio", true), ["B varies more", "A varies more"]);
  assert.deepEqual(scaleEnds("means", true), ["inwards", "outwards"]);
});

test("signs are shown, rounding error is not", () => {
  assert.equal(signed(1.5), "+1.50");
  assert.equal(signed(-1.5), "−1.50");
  assert.equal(signed(0), "0");
  assert.equal(withoutRoundingError(1e-16, 3), 0);
  assert.equal(withoutRoundingError(1e-3, 3), 1e-3);
});

test("semi-axes are the lengths of the columns, so many deviations each", () => {
  assert.deepEqual(semiAxes({ centre: [1, 1], axes: [3, 4, 0, -2] }, 2), [10, 4]);
});

function sceneWith(more: Partial<Scene>): Scene {
  const geometry = {
    dimension: 2 as const,
    kind: "shape" as const,
    mean: Float32Array.from([0, 0, 1, 0]),
    triangles: null,
    segments: Uint32Array.from([0, 1]),
    vertexSd: Float32Array.from([1, 2]),
  };
  const shapes = {
    region: "a" as const,
    mean: geometry.mean,
    vertexSd: geometry.vertexSd,
    samples: new Float32Array(0),
    count: 0,
    source: "draws" as const,
  };
  return {
    geometry: { a: geometry, b: geometry },
    compared: null,
    shapes: { a: shapes },
    mode: "sd",
    dark: false,
    fadeRim: false,
    ...more,
  };
}

test("a map colours vertices where it has as many numbers; else standard deviations only without one", () => {
  const valuesIn = (map: Scene["map"]) => contentsOf(sceneWith({ map }), ["a"])[0]?.values ?? null;
  assert.deepEqual(valuesIn(undefined), Float32Array.from([1, 2]));
  const values = Float32Array.from([-1, 1]);
  assert.equal(valuesIn({ values: { a: values }, palette: "diverging" }), values);
  const others = { a: Float32Array.from([1, 2, 3]) };
  assert.equal(valuesIn({ values: others, palette: "diverging" }), null);
  assert.equal(valuesIn({ values: {}, palette: "diverging" }), null);
});

test("an ellipsoid is drawn at two standard deviations, in any view, if it is of this space", () => {
  const a = { centre: [0, 0], axes: [1, 0, 0, 0.5] };
  const [content] = contentsOf(sceneWith({ mode: "mean", ellipsoids: { a } }), ["a"]);
  assert.deepEqual(content?.ellipsoid?.axes, [2, 0, 0, 1]);
  const space = { centre: [0, 0, 0], axes: Array<number>(9).fill(1) };
  const [other] = contentsOf(sceneWith({ ellipsoids: { a: space } }), ["a"]);
  assert.equal(other?.ellipsoid ?? null, null);
});
