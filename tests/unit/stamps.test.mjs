/** What was built is built again exactly when something that it is made of has changed. */
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync, utimesSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { isFresh, setStamp, takeStamp } from "../../scripts/steps/stamps.mjs";

/** A thing made of src/ without src/bin, built. */
function built(t) {
  const home = mkdtempSync(join(tmpdir(), "shapevenn-stamps-"));
  t.after(() => rmSync(home, { recursive: true, force: true }));
  for (const folder of ["src/inner", "src/bin", "out"])
    mkdirSync(join(home, folder), { recursive: true });
  const write = (path, text) => writeFileSync(join(home, path), text);
  write("src/lib.rs", "one");
  write("src/inner/mod.rs", "two");
  write("src/bin/main.rs", "three");
  write("other.txt", "four");
  write("out/engine.wasm", "product");
  const tools = { version: "1" };
  const thing = {
    ...{ home, name: "thing", sources: ["src"], skip: ["src/bin"], products: ["out"] },
    tools: () => tools.version,
  };
  setStamp(thing, takeStamp(thing));
  assert.ok(isFresh(thing), "it is there and nothing has changed");
  return { home, thing, write, tools };
}

test("what has not changed is not built again: touched, copied, or no part of it", (t) => {
  const { home, thing, write } = built(t);
  const later = new Date(Date.now() + 60_000);
  utimesSync(join(home, "src/lib.rs"), later, later);
  assert.ok(isFresh(thing), "touched");
  write("src/lib.rs", "one");
  assert.ok(isFresh(thing), "written again with the same contents");
  write("src/bin/main.rs", "another program");
  write("other.txt", "something else");
  assert.ok(isFresh(thing), "what it is not made of has changed");
});

const changes = {
  "a source is edited": ({ write }) => write("src/inner/mod.rs", "two!"),
  "a source is added": ({ write }) => write("src/inner/new.rs", ""),
  "a source is deleted": ({ home }) => rmSync(join(home, "src/inner/mod.rs")),
  "a source is renamed": ({ home, write }) => {
    rmSync(join(home, "src/inner/mod.rs"));
    write("src/inner/name.rs", "two");
  },
  "a product is deleted": ({ home }) => rmSync(join(home, "out/engine.wasm")),
  "all products are deleted": ({ home }) => rmSync(join(home, "out"), { recursive: true }),
  "a product is written over": ({ write }) => write("out/engine.wasm", "by something else"),
  "the compiler is another one": ({ tools }) => {
    tools.version = "2";
  },
  "a build was begun and has failed": ({ thing }) => takeStamp(thing),
};

for (const [name, change] of Object.entries(changes)) {
  test(`it is built again when ${name}`, (t) => {
    const all = built(t);
    change(all);
    assert.ok(!isFresh(all.thing), name);
  });
}

test("an edit while it is being built is not lost", (t) => {
  const { thing, write } = built(t);
  const before = takeStamp(thing);
  write("src/lib.rs", "edited meanwhile");
  setStamp(thing, before);
  assert.ok(!isFresh(thing));
});
