/** Remembers what was built from what, so that nothing is built twice. */
import { createHash } from "node:crypto";
import {
  existsSync,
  mkdirSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
  writeFileSync,
} from "node:fs";
import { dirname, join } from "node:path";
import { cache, root } from "./run.mjs";

/** All files under the given files and folders, in order, except under `skip`. */
function filesUnder(paths, skip = []) {
  const found = [];
  const visit = (path) => {
    if (skip.includes(path) || !existsSync(join(root, path))) return;
    if (statSync(join(root, path)).isDirectory()) {
      for (const name of readdirSync(join(root, path)).sort()) visit(`${path}/${name}`);
    } else {
      found.push(path);
    }
  };
  for (const path of paths) visit(path);
  return found;
}

/** Names and contents of the sources: a new checkout with old contents needs no build. */
function contents(sources, skip) {
  const hash = createHash("sha256");
  for (const path of filesUnder(sources, skip)) {
    hash
      .update(`${path}\0`)
      .update(readFileSync(join(root, path)))
      .update("\0");
  }
  return hash.digest("hex");
}

/** Names, sizes and times of the products: notices one that was deleted or written over. */
function outline(products) {
  const hash = createHash("sha256");
  for (const path of filesUnder(products)) {
    const { size, mtimeMs } = statSync(join(root, path));
    hash.update(`${path}\0${size}\0${mtimeMs}\0`);
  }
  return hash.digest("hex");
}

/** `{name, sources, skip, products}`: one thing to build, its sources and where it goes. */
export function isFresh({ name, sources, skip = [], products }) {
  if (!products.every((path) => existsSync(join(root, path)))) return false;
  try {
    const stamp = JSON.parse(readFileSync(stampFile(name), "utf8"));
    return stamp.sources === contents(sources, skip) && stamp.products === outline(products);
  } catch {
    return false;
  }
}

/** Call after building; `before` is `takeStamp`'s answer from before, lest an edit go unseen. */
export function setStamp({ name, products }, before) {
  mkdirSync(dirname(stampFile(name)), { recursive: true });
  writeFileSync(stampFile(name), JSON.stringify({ sources: before, products: outline(products) }));
}

export function takeStamp({ name, sources, skip = [] }) {
  rmSync(stampFile(name), { force: true });
  return contents(sources, skip);
}

function stampFile(name) {
  return join(cache, "stamps", `${name}.json`);
}
