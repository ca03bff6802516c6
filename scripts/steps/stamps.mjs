/** Remembers what was built from what, so that nothing is built twice, and everything that must be is. */
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
function filesUnder(home, paths, skip = []) {
  const found = [];
  const visit = (path) => {
    if (skip.includes(path) || !existsSync(join(home, path))) return;
    if (statSync(join(home, path)).isDirectory()) {
      for (const name of readdirSync(join(home, path)).sort()) visit(`${path}/${name}`);
    } else {
      found.push(path);
    }
  };
  for (const path of paths) visit(path);
  return found;
}

/** Names and contents of the sources, and the tools: a new checkout with old contents needs no build. */
function contents({ home = root, sources, skip, tools = () => "" }) {
  const hash = createHash("sha256").update(`${tools()}\0`);
  for (const path of filesUnder(home, sources, skip)) {
    hash
      .update(`${path}\0`)
      .update(readFileSync(join(home, path)))
      .update("\0");
  }
  return hash.digest("hex");
}

/** Names, sizes and times of the products: notices one that was deleted or written over. */
function outline({ home = root, products }) {
  const hash = createHash("sha256");
  for (const path of filesUnder(home, products)) {
    const { size, mtimeMs } = statSync(join(home, path));
    hash.update(`${path}\0${size}\0${mtimeMs}\0`);
  }
  return hash.digest("hex");
}

/**
 * `{name, sources, skip, tools, products}`: one thing to build, its sources, what says which tools build it, and where it
 * goes. `home`: the folder that all of them are in, else the checkout.
 */
export function isFresh(thing) {
  const { home = root, products } = thing;
  if (!products.every((path) => existsSync(join(home, path)))) return false;
  try {
    const stamp = JSON.parse(readFileSync(stampFile(thing), "utf8"));
    return stamp.sources === contents(thing) && stamp.products === outline(thing);
  } catch {
    return false;
  }
}

/** Call after building; `before` is `takeStamp`'s answer from before, lest an edit go unseen. */
export function setStamp(thing, before) {
  mkdirSync(dirname(stampFile(thing)), { recursive: true });
  writeFileSync(stampFile(thing), JSON.stringify({ sources: before, products: outline(thing) }));
}

/** Call before building: while it goes on, and if it fails, nothing counts as fresh. */
export function takeStamp(thing) {
  rmSync(stampFile(thing), { force: true });
  return contents(thing);
}

function stampFile({ home, name }) {
  return join(home ? join(home, ".setup") : cache, "stamps", `${name}.json`);
}
