/**
 * The five pairs of models whose first screen is looked at: packaged heads, real landmarks, two samples of one population, a
 * model with itself, and two models that do not meet.
 */
import { mkdirSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { must, root } from "./run.mjs";

/** A contour of 24 points about the origin that grows and is drawn out. */
function contour(radius) {
  const around = Array.from({ length: 24 }, (_, i) => (2 * Math.PI * i) / 24);
  const points = (x, y) => around.flatMap((t) => [x * Math.cos(t), y * Math.sin(t)]);
  return {
    format: "shapevenn-model",
    version: 1,
    dimension: 2,
    unit: "mm",
    mean: points(radius, radius),
    modes: [points(1, 1), points(1, -1)].map((mode) => mode.map((x) => x / Math.sqrt(24))),
    standardDeviations: [2, 2],
    segments: around.map((_, i) => [i, (i + 1) % around.length]),
  };
}

const json = (name, model) => ({ name, bytes: Buffer.from(JSON.stringify(model)) });

/** The meshes of a sample, which `cargo bench --bench evidence` writes. */
function sample(name) {
  const folder = join(root, ".setup/bench", name);
  return readdirSync(folder).map((file) => ({
    name: `${name}/${file}`,
    bytes: readFileSync(join(folder, file)),
  }));
}

/** `drops`: what is dropped on the page one after the other, on the side of A, then on that of B. */
export const PAIRS = [
  { name: "heads", link: "" },
  { name: "wings", link: "demo=wings" },
  {
    name: "one-population",
    link: "",
    async drops() {
      const into = join(root, ".setup/bench");
      mkdirSync(into, { recursive: true });
      const bench = ["bench", "--quiet", "--locked", "--bench", "evidence", "--", "--write", into];
      await must("cargo", bench, { hint: "read what the compiler says above." });
      return [sample("male"), sample("more")];
    },
  },
  { name: "itself", link: "a=demo:heads-male&b=demo:heads-male" },
  {
    name: "apart",
    link: "demo=planes",
    drops: () => [[json("small.json", contour(30)), json("large.json", contour(50))]],
  },
];
