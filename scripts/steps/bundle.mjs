/** Bundles TypeScript for Node, which from version 20 on does not read it everywhere. */
import { join } from "node:path";
import { cache, root } from "./run.mjs";

/** `input`: files by the names that they get, as .mjs, in .setup/`folder`. Resolves to where they are. */
export async function bundle(folder, input) {
  const outDir = join(cache, folder);
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
      emptyOutDir: true,
      sourcemap: "inline",
      rolldownOptions: { input, output: { entryFileNames: "[name].mjs" } },
    },
  });
  return Object.keys(input).map((name) => join(outDir, `${name}.mjs`));
}
