/**
 * `npm run dev`: serves the page as you edit it. A change in the page is there at once; one in Rust rebuilds the engine,
 * quickly rather than fast, and then reloads the page.
 */
import { join } from "node:path";
import { buildEngine } from "./build.mjs";
import { ensureNode } from "./setup.mjs";
import { explain, main, root } from "./steps/run.mjs";

/** Editors write a file in several steps. */
const SETTLED_MS = 200;

await main(async () => {
  await ensureNode();
  await buildEngine({ quick: true });
  const { createServer } = await import("vite");
  const server = await createServer();
  await server.listen();
  server.printUrls();

  let [building, again, timer] = [false, false, null];
  const rebuild = async () => {
    again = building;
    if (building) return;
    building = true;
    try {
      if (await buildEngine({ quick: true })) server.ws.send({ type: "full-reload" });
    } catch (error) {
      // What the compiler says; the engine before goes on.
      explain(error);
    }
    building = false;
    if (again) rebuild();
  };
  server.watcher.add(["src", "xtask", "Cargo.toml", "Cargo.lock"].map((path) => join(root, path)));
  server.watcher.on("all", (_, path) => {
    if (!/\.rs$|Cargo\.(toml|lock)$/.test(path)) return;
    clearTimeout(timer);
    timer = setTimeout(rebuild, SETTLED_MS);
  });
});
