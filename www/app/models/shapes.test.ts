import assert from "node:assert/strict";
import { test } from "node:test";
import { type Files, type Slot, slotKey } from "../state/state";
import { mayBeShapesOf, nameOfShapes } from "./shapes";

const files = (...names: string[]) => names.map((name) => ({ name, blob: new Blob() }));
let serial = 0;
function filesSource(name: string, files: Files["files"]): Files {
  serial += 1;
  return { kind: "files", name, files, serial };
}
const meshes = filesSource("males", files("males/1.ply", "males/2.ply"));
const slot = (given: object): Slot =>
  ({
    source: filesSource("male.h5", files("male.h5")),
    part: "shape",
    parts: ["shape"],
    reading: "",
    origin: { kind: "file" },
    ...given,
  }) as unknown as Slot;

test("a set of meshes may be the shapes of a model of a file", () => {
  assert.ok(mayBeShapesOf(slot({}), meshes));
  assert.equal(mayBeShapesOf(null, meshes), false, "nothing is open");
  const demo = slot({ source: { kind: "demo", name: "heads-male" } });
  assert.equal(mayBeShapesOf(demo, meshes), false, "an example makes way");
  const made = slot({ origin: { kind: "shapes", count: 9, scaled: false } });
  assert.equal(mayBeShapesOf(made, meshes), false, "it knows its shapes");
  assert.equal(mayBeShapesOf(slot({}), filesSource("b", files("b.h5"))), false, "a model");
  assert.equal(
    mayBeShapesOf(slot({}), filesSource("b", files("b.h5", "b.ply"))),
    false,
    "with faces",
  );
});

test("a model with other shapes beside it is another model", () => {
  const bare = slot({});
  const keys = [null, meshes, filesSource("males", meshes.files)].map((shapes) =>
    slotKey({ ...bare, shapes }),
  );
  assert.equal(new Set(keys).size, 3);
  assert.equal(slotKey({ ...bare, shapes: null }), slotKey(bare), "none");
});

test("shapes are called by their folder, or by the only file", () => {
  assert.equal(nameOfShapes(files("males/a/1.ply", "males/a/2.ply")), "males");
  assert.equal(nameOfShapes(files("males.tps")), "males.tps");
  assert.equal(nameOfShapes(files("1.ply", "2.ply")), "2 files");
});
