/** The list of the gallery, which is TypeScript, for scripts and tests. */
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { cache, root } from "./steps/run.mjs";

const outDir = join(cache, "exhibits");
const { build } = await import("vite");
await build({
  configFile: false,
  root,
  publicDir: false,
  logLevel: "warn",
  build: {
    ssr: true,
    target: "node20",
    outDir,
    rolldownOptions: {
      input: join(root, "www/app/gallery.ts"),
      output: { entryFileNames: "exhibits.mjs" },
    },
  },
});

export const { EXHIBITS, linkTo } = await import(pathToFileURL(join(outDir, "exhibits.mjs")).href);
