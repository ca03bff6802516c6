/**
 * `npm run zip`: the page and a server for it in one file, for a room without a network. Unzip it, then
 * `python3 serve.py`. Browsers run no modules and no workers from file://, so some server it takes.
 */
import { readdir, readFile, writeFile } from "node:fs/promises";
import { join, relative, sep } from "node:path";
import { zipSync } from "fflate";
import { build } from "./build.mjs";
import { isMain, main, root } from "./steps/run.mjs";

/** What only a host on the web reads. */
const leftOut = new Set(["_headers"]);

/** The files of dist/ and serve.py, all below one folder so that unzipping scatters nothing. */
export async function zipPage(target = join(root, "shapevenn.zip")) {
  const dist = join(root, "dist");
  const found = await readdir(dist, { recursive: true, withFileTypes: true });
  const files = {};
  for (const entry of found.filter((one) => one.isFile() && !leftOut.has(one.name))) {
    // Node 20 calls it `path`, later versions `parentPath`.
    const path = join(entry.parentPath ?? entry.path, entry.name);
    files[`shapevenn/${relative(dist, path).split(sep).join("/")}`] = await readFile(path);
  }
  files["shapevenn/serve.py"] = await readFile(join(root, "scripts/serve.py"));
  const bytes = zipSync(files, { level: 9 });
  await writeFile(target, bytes);
  return bytes.length;
}

if (isMain(import.meta.url)) {
  await main(async () => {
    await build();
    const size = await zipPage();
    console.log(
      `shapevenn.zip has ${(size / 1e6).toFixed(1)} MB. Unzip it, then: python3 serve.py`,
    );
  });
}
