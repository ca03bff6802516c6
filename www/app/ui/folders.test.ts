import assert from "node:assert/strict";
import { test } from "node:test";
import { type Entry, filesBelow, filesOf } from "./folders";

const file = (fullPath: string, readable = true) => ({
  isFile: true,
  isDirectory: false,
  name: fullPath.split("/").pop() ?? "",
  fullPath,
  file: (done: (file: File) => void, failed: (reason: unknown) => void) =>
    readable ? done(new File(["x"], fullPath)) : failed("gone"),
});

/** A folder that returns its entries `atOnce` at a time, as browsers do. */
const folder = (fullPath: string, entries: Entry[], atOnce = 100) => ({
  isFile: false,
  isDirectory: true,
  name: fullPath.split("/").pop() ?? "",
  fullPath,
  createReader() {
    let given = 0;
    return {
      readEntries(done: (entries: Entry[]) => void) {
        done(entries.slice(given, given + atOnce));
        given += atOnce;
      },
    };
  },
});

const names = async (entries: Entry[]) => (await filesBelow(entries)).map(({ name }) => name);

test("folders are read to the bottom, files keep their path", async () => {
  const tree = [
    folder("/female", [file("/female/1.ply"), folder("/female/old", [file("/female/old/2.ply")])]),
    file("/model.h5"),
  ];
  assert.deepEqual(await names(tree), ["female/1.ply", "female/old/2.ply", "model.h5"]);
});

test("a long folder is read in full, ten after nine", async () => {
  const many = Array.from({ length: 250 }, (_, i) => file(`/set/${i + 1}.ply`));
  const found = await names([folder("/set", many)]);
  assert.equal(found.length, 250);
  assert.deepEqual(found.slice(8, 11), ["set/9.ply", "set/10.ply", "set/11.ply"]);
});

test("what systems leave in folders is no model, nor is what cannot be read", async () => {
  const tree = [
    folder("/set", [
      file("/set/.DS_Store"),
      file("/set/Thumbs.db"),
      file("/set/1.ply"),
      file("/set/2.ply", false),
      folder("/set/__MACOSX", [file("/set/__MACOSX/1.ply")]),
    ]),
  ];
  assert.deepEqual(await names(tree), ["set/1.ply"]);
});

test("a chosen folder gives paths, chosen files their names", () => {
  const inFolder = Object.assign(new File(["x"], "1.ply"), { webkitRelativePath: "set/1.ply" });
  const given = filesOf([inFolder, new File(["x"], "m.h5"), new File(["x"], ".DS_Store")]);
  assert.deepEqual(
    given.map(({ name }) => name),
    ["set/1.ply", "m.h5"],
  );
});
