/**
 * Some cargo features would change numbers behind our back, and any new dependency may switch
 * them on for everyone: `num-traits/std` sends rand_distr and others to the platform's exp, ln,
 * sin, whose last bit differs between machines; `nalgebra/std` brings kernels that depend on the processor.
 */
import { must } from "./steps/run.mjs";

const forbidden = [
  ["num-traits", "std"],
  ["nalgebra", "std"],
  ["nalgebra", "matrixmultiply"],
];

const builds = {
  "native program": [],
  engine: ["--no-default-features", "--target", "wasm32-unknown-unknown"],
};

/** One check: `{passed, failed, output}`. */
export async function checkFeatures() {
  const sentences = [];
  for (const [build, options] of Object.entries(builds)) {
    // Without development dependencies: they are no part of what is shipped.
    const args = ["tree", "--locked", "-p", "shapevenn", "-e", "normal", "--prefix", "none"];
    const tree = await must("cargo", [...args, "--format", "{p}|{f}", ...options]);
    for (const [crate, feature] of forbidden) {
      const on = tree.split("\n").some((line) => {
        const [name = "", features = ""] = line.split("|");
        return (
          name.startsWith(`${crate} `) && features.replace(" (*)", "").split(",").includes(feature)
        );
      });
      if (on) {
        sentences.push(
          `The ${build} has ${crate} with its feature "${feature}", so its numbers depend on the machine. ` +
            `\`cargo tree -e features -i ${crate}\` shows who asks for it.`,
        );
      }
    }
  }
  const ok = sentences.length === 0;
  return { passed: ok ? 1 : 0, failed: ok ? 0 : 1, output: sentences.join("\n") };
}
