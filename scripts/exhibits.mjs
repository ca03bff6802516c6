/** The list of the gallery, which is TypeScript, for scripts and tests. */
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { bundle } from "./steps/bundle.mjs";
import { root } from "./steps/run.mjs";

const [file] = await bundle("exhibits", { gallery: join(root, "www/app/gallery/exhibits.ts") });

export const { ENGINE, EXHIBITS, linkTo } = await import(pathToFileURL(file).href);
