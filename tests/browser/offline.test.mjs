/** The page in a zip, for a room without a network: one command, and nothing asks for another host. */
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { unzipSync } from "fflate";
import { zipPage } from "../../scripts/zip.mjs";
import { temporaryFolder } from "./command.mjs";
import { metric, untilState, withPage } from "./harness.mjs";

/** What the page is in, unzipped as anybody would. */
async function unzipped(t) {
  const folder = temporaryFolder(t);
  await zipPage(join(folder, "shapevenn.zip"));
  const files = unzipSync(await readFile(join(folder, "shapevenn.zip")));
  for (const [name, bytes] of Object.entries(files)) {
    await mkdir(dirname(join(folder, name)), { recursive: true });
    await writeFile(join(folder, name), bytes);
  }
  return join(folder, "shapevenn");
}

/** Starts a command of Python's in the folder; resolves to the first line that it says, and its end. */
function python(t, folder, ...args) {
  const child = spawn("python3", ["-u", ...args], { cwd: folder });
  t.after(() => child.kill());
  let said = "";
  const ended = new Promise((done) => child.on("close", done));
  const line = new Promise((done) => {
    const listen = (data) => {
      said += data;
      if (said.includes("\n")) done(said);
    };
    child.stdout.on("data", listen);
    child.stderr.on("data", listen);
  });
  return { line, ended };
}

/** Opens the page with no other host to be had, and compares. */
async function compares(address, threads) {
  await withPage({}, async ({ page }) => {
    const beyond = [];
    await page.context().route("**", (route) => {
      const { hostname } = new URL(route.request().url());
      if (hostname === "localhost") return route.continue();
      beyond.push(route.request().url());
      return route.abort();
    });
    await page.goto(`${address}#v=1&demo=stars-1&draws=400`);
    await untilState(page, "done");
    assert.ok((await metric(page, "overlap.varianceOfAInB")) > 0);
    await page.goto(`${address}#v=1&demo=heads-sex&sigma=2&draws=400&perms=0`);
    await page.reload();
    await untilState(page, "done");
    await page.goto(`${address}#v=1&page=learn&scene=step&steps=137`);
    await page.reload();
    await untilState(page, "done");
    assert.ok((await metric(page, "figures.acceptance")) > 0.5);
    assert.equal(await page.evaluate(() => crossOriginIsolated), threads);
    assert.deepEqual(beyond, []);
  });
}

test("unzipped, `python3 serve.py` serves the page with all processors, to this computer only", async (t) => {
  const folder = await unzipped(t);
  const { line } = python(t, folder, "serve.py", "0");
  const address = /http:\/\/localhost:\d+\//.exec(await line)?.[0];
  assert.ok(address, await line);
  const response = await fetch(`${address}engine/${await wasm(address)}`);
  assert.equal(response.headers.get("content-type"), "application/wasm");
  await compares(address, true);
});

test("with Python's own server the page runs too, on one processor", async (t) => {
  const folder = await unzipped(t);
  const { line } = python(t, folder, "-m", "http.server", "0", "--bind", "127.0.0.1");
  const port = /port (\d+)/.exec(await line)?.[1];
  await compares(`http://localhost:${port}/`, false);
});

test("a port that is none or taken is said in words", async (t) => {
  const folder = await unzipped(t);
  const none = python(t, folder, "serve.py", "http");
  assert.match(await none.line, /“http” is no port: a number up to 65535 was expected/);
  assert.equal(await none.ended, 1);
  const first = python(t, folder, "serve.py", "0");
  const port = /localhost:(\d+)/.exec(await first.line)?.[1];
  const second = python(t, folder, "serve.py", port);
  assert.match(
    await second.line,
    new RegExp(`Port ${port} cannot be used: .*python3 serve.py 9000`),
  );
});

/** The name of the engine's file, as the folder lists it. */
async function wasm(address) {
  const listing = await (await fetch(`${address}engine/`)).text();
  return /href="([^"]+\.wasm)"/.exec(listing)?.[1];
}
