/**
 * What the features of crates must not bring along.
 *
 * Some cargo features would change numbers behind our back, and any new dependency may switch
 * them on for everyone: `num-traits/std` sends rand_distr and others to the platform's exp, ln,
 * sin, whose last bit differs between machines; `nalgebra/std` brings kernels that depend on the processor.
 *
 * The crates of the command line are no part of the library: who leaves out the default features does not get them.
 */
import { attempt, must } from "./steps/run.mjs";

const forbidden = [
  ["num-traits", "std"],
  ["nalgebra", "std"],
  ["nalgebra", "matrixmultiply"],
];

const builds = {
  "native program": [],
  engine: ["--no-default-features", "--target", "wasm32-unknown-unknown"],
};

const libraryAlone = ["--locked", "-p", "shapevenn", "--no-default-features"];
const commandLine = ["clap", "form_urlencoded", "indicatif"];

/** The crates and their features that a build ships, one a line; without development dependencies. */
function dependencies(format, options) {
  return must("cargo", [
    ...["tree", "-e", "normal", "--prefix", "none", "--format", format],
    ...options,
  ]);
}

/** That the library builds without the command line, and without the crates that only that needs. */
export async function checkLibrary() {
  const tree = await dependencies("{p}", libraryAlone);
  const crates = new Set(tree.split("\n").map((line) => line.split(" ")[0]));
  const found = commandLine.filter((crate) => crates.has(crate));
  if (found.length > 0) {
    const output =
      `A library without default features should do without ${commandLine.join(", ")}, but it has ${found.join(", ")}. ` +
      `\`cargo tree --no-default-features -i ${found[0]}\` shows who asks for it.`;
    return { passed: 0, failed: 1, output };
  }
  const { ok, output } = await attempt("cargo", ["check", "--quiet", "--lib", ...libraryAlone]);
  return { passed: ok ? 1 : 0, failed: ok ? 0 : 1, output };
}

/** One check: `{passed, failed, output}`. */
export async function checkFeatures() {
  const sentences = [];
  for (const [build, options] of Object.entries(builds)) {
    const tree = await dependencies("{p}|{f}", ["--locked", "-p", "shapevenn", ...options]);
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
