/** A file uses only what stands above it in these lists: arrows between folders point one way, and there is no circle. */
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { posix } from "node:path";
import { test } from "node:test";

/** Folders and files in the order in which they may be used, by the folder that they are in. */
const RUST = {
  src: [
    ...[
      "testing",
      "text",
      "linalg",
      "model",
      "sampling",
      "formats",
      "pair",
      "measure",
      "settings",
      "report",
    ],
    ...[
      "evidence",
      "error",
      "inspect",
      "relate",
      "demos",
      "comparison",
      "files",
      "lessons",
      "reproduce",
    ],
    ...["roofline", "remedies", "typescript", "wasm", "bin"],
  ],
  "src/formats": [
    ...[
      "condition",
      "reading",
      "error",
      "opened",
      "input",
      "containers",
      "mesh",
      "landmarks",
      "readers",
      "several",
      "write",
      "open",
    ],
  ],
};

const PAGE = {
  "www/app": [
    ...[
      "text",
      "state",
      "ui",
      "viewer",
      "models",
      "comparison",
      "stage",
      "pictures",
      "learn",
      "link",
    ],
    ...["tabs", "share", "panels", "gallery", "shell", "main"],
  ],
};

function filesIn(folder, ending) {
  return readdirSync(folder, { recursive: true })
    .map((name) => posix.join(folder, name.replaceAll("\\", "/")))
    .filter((name) => ending.test(name));
}

/** `crate::a::{b, c::d}` as paths; only what is taken from this crate. */
function pathsOf(tree) {
  const [, head, list] = /^((?:\w+::)*)\{([\s\S]*)\}$/.exec(tree.trim()) ?? [];
  if (list === undefined) return [tree.trim().split("::")];
  const parts = [];
  let [depth, part] = [0, ""];
  for (const letter of `${list},`) {
    if (letter === "{") depth += 1;
    if (letter === "}") depth -= 1;
    if (letter === "," && depth === 0) {
      if (part.trim() !== "") parts.push(...pathsOf(head + part.trim()));
      part = "";
    } else part += letter;
  }
  return parts;
}

/** The modules of this crate that a file uses outside of its tests, as `src/a/b`. */
function usedByRust(file, text) {
  const here = file.replace(/(\/mod)?\.rs$/, "").split("/");
  const code = text.replace(/^\s*\/\/.*$/gm, "").split(/^#\[cfg\(test\)\]\nmod tests/m)[0];
  const trees = code.match(/(?<![\w:])(?:crate|super)(?:::\w+)*(?:::\{(?:[^{}]|\{[^{}]*\})*\})?/g);
  return (trees ?? []).flatMap(pathsOf).map(([first, ...rest]) => {
    if (first === "crate") return ["src", ...rest].join("/");
    const ups = 1 + rest.findIndex((name) => name !== "super");
    return [...here.slice(0, -ups), ...rest.slice(ups - 1)].join("/");
  });
}

/** One sentence for each arrow that points up. */
function upward(orders, edges) {
  const found = new Set();
  for (const [file, from, to] of edges) {
    for (const [folder, order] of Object.entries(orders)) {
      const place = (path) => {
        const [name] = path.slice(folder.length + 1).split("/");
        return path.startsWith(`${folder}/`) ? order.indexOf(name.replace(/\.\w+$/, "")) : -1;
      };
      const [user, used] = [place(from), place(to)];
      if (user < 0 || used <= user) continue;
      found.add(
        `${file} uses ${to}, but ${folder}/${order[user]} stands above ${order[used]}: what both need belongs in ${order[user]} or higher up.`,
      );
    }
  }
  return [...found];
}

test("Rust: a module uses only modules that stand above it", () => {
  const files = filesIn("src", /\.rs$/).filter((file) => file !== "src/lib.rs");
  const edges = files.flatMap((file) =>
    usedByRust(file, readFileSync(file, "utf8")).map((to) => [file, file, to]),
  );
  assert.ok(edges.length > 500, `only ${edges.length} uses were found`);
  assert.deepEqual(upward(RUST, edges), []);
});

test("page: a file imports only from folders that stand above its own", () => {
  const files = filesIn("www/app", /(?<!\.test)\.tsx?$/);
  const edges = files.flatMap((file) =>
    [...readFileSync(file, "utf8").matchAll(/(?:from|import)\s*\(?\s*"(\.[^"]+)"/g)].map(
      ([, path]) => [file, file, posix.join(posix.dirname(file), path)],
    ),
  );
  assert.ok(edges.length > 800, `only ${edges.length} imports were found`);
  assert.deepEqual(upward(PAGE, edges), []);
});

test("every folder and file of the lists is there, and no other", () => {
  for (const [folder, order] of Object.entries({ ...RUST, ...PAGE })) {
    const there = new Set(readdirSync(folder).map((name) => name.replace(/\.\w+$/, "")));
    for (const name of ["lib", "mod"]) there.delete(name);
    assert.deepEqual([...there].sort(), [...order].sort(), folder);
  }
});

test("an arrow that points up is found, and named", () => {
  const text = "use crate::pair::{self, kernel::Kernel};\nuse super::super::comparison::Run;\n";
  const used = usedByRust("src/linalg/svd.rs", text);
  assert.deepEqual(used, ["src/pair/self", "src/pair/kernel/Kernel", "src/comparison/Run"]);
  const [first] = upward(RUST, [["src/linalg/svd.rs", "src/linalg/svd.rs", used[1]]]);
  assert.match(first, /^src\/linalg\/svd\.rs uses src\/pair\/kernel\/Kernel/);
});

test("every folder says at its head what it is for", () => {
  const heads = filesIn("src", /\/mod\.rs$/).filter(
    (file) => !readFileSync(file, "utf8").startsWith("//! "),
  );
  assert.deepEqual(heads, []);
});
