import { cp, readdir, readFile } from "node:fs/promises";
import { extname, join, resolve } from "node:path";
import { defineConfig, type Plugin } from "vite";

/**
 * Without these two headers on every response, worker scripts included, workers cannot share the engine's
 * memory, and it runs alone in one.
 */
const isolation = {
  "Cross-Origin-Opener-Policy": "same-origin",
  "Cross-Origin-Embedder-Policy": "require-corp",
};

/** Data kept beside its origin in the repository, and where the page asks for it. */
const folders = { demos: "demos/heads", first: "www/first" };
const shipped = new Set([".npz", ".json"]);

async function filesIn(folder: string): Promise<string[]> {
  const names = await readdir(folder).catch(() => []);
  return names.filter((name) => shipped.has(extname(name))).sort();
}

/** Serves `folders` in development and copies them into `dist/`. */
function dataFolders(): Plugin {
  let root = ".";
  let outDir = "dist";
  return {
    name: "data-folders",
    configResolved(config) {
      root = config.root;
      outDir = resolve(root, config.build.outDir);
    },
    configureServer(server) {
      server.middlewares.use(async (request, response, next) => {
        const [, folder = "", name = ""] = (request.url ?? "").split(/[/?#]/);
        const source = (folders as Record<string, string>)[folder];
        if (source === undefined || !(await filesIn(join(root, source))).includes(name)) {
          return next();
        }
        const json = name.endsWith(".json");
        response.setHeader("Content-Type", json ? "application/json" : "application/octet-stream");
        response.end(await readFile(join(root, source, name)));
      });
    },
    async writeBundle() {
      for (const [folder, source] of Object.entries(folders)) {
        for (const name of await filesIn(join(root, source))) {
          await cp(join(root, source, name), join(outDir, folder, name));
        }
      }
    },
  };
}

export default defineConfig({
  // Relative, so that dist/ works from any folder of any static host.
  base: "./",
  publicDir: "www/public",
  plugins: [dataFolders()],
  worker: { format: "es" },
  server: { headers: isolation },
  preview: { headers: isolation },
  build: {
    target: "es2022",
    // three.js alone is over the default.
    chunkSizeWarningLimit: 700,
    license: { fileName: "licenses.md" },
  },
});
