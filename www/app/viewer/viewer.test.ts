import assert from "node:assert/strict";
import { test } from "node:test";
import { HOME, orbit, zoomBy } from "../state/camera";
import { commonRange, viridis } from "../text/colormap";
import { contentsOf, type Scene } from "./contents";
import { pickVertex } from "./pick";
import { rimFade } from "./rim";
import { cellsOf, frameOf } from "./viewer";

test("an open rim fades, a closed surface does not", () => {
  const tetrahedron = Uint32Array.from([0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2]);
  assert.equal(rimFade(tetrahedron, 4, 2), null);
  const fade = rimFade(tetrahedron.subarray(0, 9), 4, 2);
  assert.deepEqual([...(fade ?? [])], [0.5, 0, 0, 0]);
});

test("cells hold every shape and stay in their pane", () => {
  const pane = { x: 10, y: 20, width: 300, height: 200 };
  const cells = cellsOf(pane, 9, { centre: [0, 0, 0], halfWidth: 1, halfHeight: 1.3 });
  assert.equal(cells.length, 9);
  for (const cell of cells) {
    assert.ok(cell.x >= 10 && cell.x + cell.width <= 310.001);
    assert.ok(cell.y >= 20 && cell.y + cell.height <= 220.001);
  }
});

test("a frame holds a shape from every side", () => {
  const frame = frameOf([Float32Array.from([-1, -2, -3, 1, 2, 3])], 3);
  assert.deepEqual(frame.centre, [0, 0, 0]);
  assert.equal(frame.halfWidth, Math.hypot(1, 3));
  assert.equal(frame.halfHeight, 2);
});

test("the nearest of two vertices under the pointer is picked", () => {
  const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  const points = Float32Array.from([0, 0, 0.5, 0, 0, -0.5, 0.9, 0.9, -1]);
  const at = { x: 50, y: 50, width: 100, height: 100 };
  assert.equal(pickVertex(points, 3, identity, at)?.vertex, 1);
  assert.equal(pickVertex(points, 3, identity, { ...at, x: 20 }), null);
});

test("the camera stays upright and within its zoom", () => {
  assert.equal(orbit(HOME, 0, 10).pitch, 1.5);
  assert.equal(zoomBy(HOME, 1000).zoom, 12);
});

test("beside a model in space, one in the plane is not drawn as if it were in space", () => {
  const model = (dimension: 2 | 3) => ({
    dimension,
    kind: "shape" as const,
    mean: new Float32Array(3 * dimension),
    triangles: null,
    segments: null,
    vertexSd: new Float32Array(3),
  });
  const geometry = { a: model(3), b: model(2) };
  const scene: Scene = {
    geometry,
    compared: null,
    shapes: {},
    mode: "mean",
    dark: false,
    fadeRim: false,
  };
  const drawn = contentsOf(scene, ["a", "b"]).map(({ region }) => region);
  assert.deepEqual(drawn, ["a"]);
});

test("shapes of a run are drawn on the points that it compares", () => {
  const model = (points: number, triangles: Uint32Array | null) => ({
    dimension: 3 as const,
    kind: "shape" as const,
    mean: new Float32Array(3 * points),
    triangles,
    segments: null,
    vertexSd: new Float32Array(points),
  });
  const [whole, part] = [Uint32Array.of(0, 1, 2), Uint32Array.of(1, 2, 3)];
  const own = model(9, whole);
  const compared = { a: model(5, part), b: model(5, null) };
  const region = (name: "a" | "intersection", points: number) => ({
    region: name,
    mean: new Float32Array(3 * points),
    vertexSd: new Float32Array(points),
    samples: new Float32Array(0),
    count: 0,
    source: "draws" as const,
  });
  const scene: Scene = {
    geometry: { a: own, b: own },
    compared,
    shapes: { intersection: region("intersection", 5) },
    mode: "mean",
    dark: false,
    fadeRim: false,
  };
  const [drawn] = contentsOf(scene, ["intersection"]);
  assert.equal(drawn?.triangles, part);
  // Before there are shapes, the model itself.
  assert.equal(contentsOf(scene, ["a"])[0]?.triangles, whole);
  // As many points as the model has, but others: still those of the run.
  const others = { a: model(9, part), b: model(9, null) };
  const shapes = { a: region("a", 9) };
  assert.equal(contentsOf({ ...scene, compared: others, shapes }, ["a"])[0]?.triangles, part);
});

test("one range holds all maps, and colours stay in it", () => {
  const maps = [Float32Array.from([2, 3]), Float32Array.from([1, 2.5])];
  assert.deepEqual(commonRange(maps), [1, 3]);
  assert.equal(commonRange([]), null);
  assert.deepEqual(viridis(-1), viridis(0));
  assert.deepEqual(viridis(Number.NaN), viridis(0));
});
