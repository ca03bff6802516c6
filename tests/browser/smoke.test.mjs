/** Before anything else: does the engine load in a worker, from the built page, on either host? */
import assert from "node:assert/strict";
import { test } from "node:test";
import { shownMetrics, untilState, withPage } from "./harness.mjs";

/**
 * Loads the engine in a worker of its own, started from a script that the server serves: blob
 * workers would not show whether worker scripts carry the headers. Resolves to what it saw.
 */
async function loadEngine(page, url, threads) {
  await page.route(`${url}load-engine.js`, (route) =>
    route.fulfill({
      contentType: "text/javascript",
      headers: { "Cross-Origin-Embedder-Policy": "require-corp" },
      body: `
        onmessage = async ({ data: { engine, threads } }) => {
          try {
            const glue = await import(engine);
            const { memory } = await glue.default();
            if (threads > 0) await glue.startThreads(threads);
            postMessage({ shared: memory.buffer.constructor.name, version: glue.Engine.version() });
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
    { script: `${url}load-engine.js`, engine: `${url}engine/shapevenn.js`, threads },
  );
}

for (const { host, isolated, threads } of [
  { host: "an isolated page runs it with two threads", isolated: true, threads: 2 },
  { host: "an isolated page runs it alone", isolated: true, threads: 0 },
  { host: "on a host without the headers it runs alone", isolated: false, threads: 0 },
]) {
  test(`the one engine, in shared memory: ${host}`, async () => {
    await withPage({ fresh: true, isolated }, async ({ url, page }) => {
      await page.goto(url);
      assert.equal(await page.evaluate(() => crossOriginIsolated), isolated);
      const { shared, version, error } = await loadEngine(page, url, threads);
      assert.equal(error, undefined);
      assert.equal(shared, "SharedArrayBuffer");
      assert.match(version, /^\d+\.\d+\.\d+$/);
    });
  });
}

test("every response of an isolated host carries the headers, worker scripts included", async () => {
  await withPage({ fresh: true, isolated: true }, async ({ url }) => {
    for (const path of ["", "engine/shapevenn.js", "engine/shapevenn_bg.wasm", "no-such"]) {
      const { headers } = await fetch(url + path);
      assert.equal(headers.get("cross-origin-opener-policy"), "same-origin", path);
      assert.equal(headers.get("cross-origin-embedder-policy"), "require-corp", path);
      if (path.endsWith(".wasm")) assert.equal(headers.get("content-type"), "application/wasm");
    }
  });
});

test("the server gives away nothing outside its folder", async () => {
  await withPage({ fresh: true }, async ({ url }) => {
    for (const path of [
      "..%2fpackage.json",
      "%2e%2e/package.json",
      "assets/..%2f..%2fpackage.json",
    ]) {
      assert.equal((await fetch(url + path)).status, 404, path);
    }
  });
});

/** Runs `script` in the engine's worker before the worker's own. */
async function inWorker(page, script) {
  await page.route("**/assets/worker-*.js", async (route) => {
    const response = await route.fetch();
    await route.fulfill({ response, body: `${script};\n${await response.text()}` });
  });
}

const LINK = "#v=1&demo=stars-1&draws=400&seed=3";
const refusing = (most) => `{
  const Memory = WebAssembly.Memory;
  WebAssembly.Memory = function (wanted) {
    if (wanted.maximum > ${most}) throw new RangeError("could not allocate memory");
    return new Memory(wanted);
  };
}`;

test("a phone that refuses memory for the worst case gets a lower ceiling", async () => {
  await withPage({ fresh: true, isolated: false }, async ({ url, page }) => {
    await inWorker(page, refusing(16384));
    await page.goto(url + LINK);
    await untilState(page, "done");
    assert.equal(await page.locator("[data-build]").getAttribute("data-build"), "serial");
  });
});

test("a browser without such memory is told which ones have it", async () => {
  await withPage({ fresh: true, isolated: false }, async ({ url, page, errors }) => {
    await inWorker(page, refusing(0));
    await page.goto(url);
    const notice = page.locator('.notice[data-code="engine-gone"]');
    await notice.getByText(/Chrome and Edge do from version 91 on, Firefox from 89/).waitFor();
    assert.ok((await shownMetrics(page)).length > 40, "the stored numbers stay readable");
    errors.length = 0;
  });
});

test("where threads do not come up, the engine runs alone", async () => {
  await withPage({ fresh: true, isolated: true }, async ({ url, page }) => {
    await inWorker(page, "delete globalThis.Worker");
    await page.goto(`${url}?threads=2${LINK}`);
    await untilState(page, "done");
    assert.equal(await page.locator("[data-build]").getAttribute("data-build"), "serial");
  });
});
