/** Every way to serve the page that comes with it sends the same headers. */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

const HEADERS = {
  "Cross-Origin-Opener-Policy": "same-origin",
  "Cross-Origin-Embedder-Policy": "require-corp",
  "Cross-Origin-Resource-Policy": "cross-origin",
  "Access-Control-Allow-Origin": "*",
  "Cache-Control": "no-cache",
};

const places = {
  "scripts/serve.mjs": 1,
  "scripts/serve.py": 1,
  "www/public/_headers": 1,
  // The table, nginx and Apache.
  "docs/hosting.md": 3,
};

for (const [file, times] of Object.entries(places)) {
  test(`${file} has all headers of the page`, () => {
    const text = readFileSync(file, "utf8");
    for (const [name, value] of Object.entries(HEADERS)) {
      const given = new RegExp(`${name}\\W+?${value.replace("*", "\\*")}`, "g");
      const found = text.match(given)?.length ?? 0;
      // How long things are kept has a paragraph instead of a row.
      const least = name === "Cache-Control" ? 1 : times;
      assert.ok(found >= least, `${name}: ${value} stands there ${found} times`);
    }
  });
}

test("the server in the zip is as short as it is said to be", () => {
  assert.ok(readFileSync("scripts/serve.py", "utf8").trimEnd().split("\n").length <= 40);
  assert.ok(readFileSync("www/public/shape-venn.js", "utf8").split("\n").length <= 150);
});
