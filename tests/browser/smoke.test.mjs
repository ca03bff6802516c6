/** Before anything else: do both engines load in a worker, from the built page, on either host? */
import assert from "node:assert/strict";
import { test } from "node:test";
import { withPage } from "./harness.mjs";

/**
 * Loads an engine in a worker of its own, started from a script that the server serves: blob
 * workers would not show whether worker scripts carry the headers. Resolves to what it saw.
 */
async function loadEngine(page, url, build) {
  await page.route(`${url}load-engine.js`, (route) =>
    route.fulfill({
      contentType: "text/javascript",
      headers: { "Cross-Origin-Embedder-Policy": "require-corp" },
      body: `
        onmessage = async ({ data: { engine, threads } }) => {
          try {
            const glue = await import(engine);
            const { memory } = await glue.default();
            if (threads > 0) await glue.initThreadPool(threads);
            postMessage({ shared: memory.buffer.constructor.name, pool: "initThreadPool" in glue });
          } catch (error) {
            postMessage({ error: String(error) });
          }
        };`,
    }),
  );
  return page.evaluate(
    ({ script, engine, threads }) =>
      new Promise((done) => {
        const worker = new Worker(script, { type: "module" });
        worker.onmessage = ({ data }) => done(data);
        worker.onerror = ({ message }) => done({ error: message || "the worker did not start" });
        worker.postMessage({ engine, threads });
      }),
    {
      script: `${url}load-engine.js`,
      engine: `${url}engine/${build}/shapevenn.js`,
      threads: build === "threads" ? 2 : 0,
    },
  );
}

test("an isolated page runs the engine with two threads", async () => {
  await withPage({ isolated: true }, async ({ url, page }) => {
    await page.goto(url);
    assert.equal(await page.evaluate(() => crossOriginIsolated), true);
    const seen = await loadEngine(page, url, "threads");
    assert.deepEqual(seen, { shared: "SharedArrayBuffer", pool: true });
  });
});

test("an isolated page runs the serial engine too", async () => {
  await withPage({ isolated: true }, async ({ url, page }) => {
    await page.goto(url);
    assert.deepEqual(await loadEngine(page, url, "serial"), { shared: "ArrayBuffer", pool: false });
  });
});

test("on a host without the headers the serial engine runs", async () => {
  await withPage({ isolated: false }, async ({ url, page }) => {
    await page.goto(url);
    assert.equal(await page.evaluate(() => crossOriginIsolated), false);
    assert.deepEqual(await loadEngine(page, url, "serial"), { shared: "ArrayBuffer", pool: false });
  });
});

test("every response of an isolated host carries the headers, worker scripts included", async () => {
  await withPage({ isolated: true }, async ({ url }) => {
    for (const path of [
      "",
      "engine/threads/shapevenn.js",
      "engine/threads/shapevenn_bg.wasm",
      "no-such",
    ]) {
      const { headers } = await fetch(url + path);
      assert.equal(headers.get("cross-origin-opener-policy"), "same-origin", path);
      assert.equal(headers.get("cross-origin-embedder-policy"), "require-corp", path);
      if (path.endsWith(".wasm")) assert.equal(headers.get("content-type"), "application/wasm");
    }
  });
});

test("the server gives away nothing outside its folder", async () => {
  await withPage({}, async ({ url }) => {
    for (const path of [
      "..%2fpackage.json",
      "%2e%2e/package.json",
      "assets/..%2f..%2fpackage.json",
    ]) {
      assert.equal((await fetch(url + path)).status, 404, path);
    }
  });
});
