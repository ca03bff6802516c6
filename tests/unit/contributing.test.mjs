/**
 * Tries every command of CONTRIBUTING.md and of the command blocks of README.md.
 *
 * Of each command it is checked that what it names is there: the npm script and the file that it runs, the package, the
 * bench, the profile, the subcommand and the options of our command line. Those that are quick are executed. `TRIED` says
 * of each what else tries it; a command that is not in it is an error, and so is an entry without a command.
 */
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";

// The script itself: in the bundle it would not know where the top of the repository is.
const { attempt } = await import(pathToFileURL(resolve("scripts/steps/run.mjs")).href);

const byTest = "npm test does the same as one of its steps";
const notHere = "takes too long, or changes files";
const cli = "tests/cli.rs runs this subcommand";

/** A `*` at the end stands for whatever follows. `execute`: run here, with these variables. */
const TRIED = {
  "npm start":
    "the workflow fetches the page from it, and every browser test serves the same folder",
  "npm test": "it is what runs this test",
  "npm run dev": "serves until somebody stops it",
  "npm run build": byTest,
  "npm run zip": "tests/browser makes the archive, unpacks and serves it",
  "npm run format": "changes files; npm run lint is the same without",
  "npm run lint": { execute: {} },
  "npm run types": { execute: {} },
  "npm run test:rust": byTest,
  "npm run test:rust -- typescript": notHere,
  "npm run test:unit": "it runs this test",
  "npm run test:browser": byTest,
  "npm run test:browser -- WORD": byTest,
  "npm run test:long": notHere,
  "npm run audit": "tests/unit/audit.test.mjs has its answers",
  "npm run fuzz": notHere,
  "npm run fuzz -- eos scm": notHere,
  "npm run fuzz -- TARGET -- -runs=1000000": notHere,
  "npm run bench": notHere,
  "npm run bench -- --sizes": notHere,
  "npm run first": "a Rust test compares what it wrote with what it would write now",
  "npm run gallery -- NAME": notHere,
  "npm run plot": notHere,
  "npm run reproduce": notHere,
  "npm run study": notHere,
  "npm run evidence-study": notHere,
  "npm run setup -- --tests": { execute: { SETUP_DRY_RUN: "1" } },
  "cargo fmt": byTest,
  "cargo clippy --all-targets": byTest,
  "cargo test": byTest,
  "cargo install --locked cargo-deny": "comes from the network",
  "cargo install cargo-fuzz": "comes from the network",
  "cargo fuzz run *": "npm run fuzz is the same command",
  "cargo fuzz tmin": "needs an input that failed",
  "cargo run --release -- compare *": cli,
  "cargo run --release -- lesson *": cli,
  "cargo run --release -- evidence *": cli,
  "cargo run --release -- evaluate *": cli,
  "cargo run --release -- sweep *": cli,
  "cargo run --release -- info *": cli,
  "cargo run --release -- inspect *": cli,
  "cargo run --release -- matrix *": cli,
  "cargo run --release -- convert *": cli,
};

const isCommand = (text) => /^(npm|node|cargo|npx|python3) /.test(text);

/** A line as it would be typed, without variables before and a remark behind. */
const bare = (line) =>
  line
    .trim()
    .replace(/\s+#\s.*$/, "")
    .replace(/^([A-Z_]+=\S+ )+/, "");

/** The commands of a document: of its blocks, and with `spans` also those within its sentences. */
function commandsOf(file, { spans }) {
  const text = readFileSync(file, "utf8");
  const fence = /^```.*\n([\s\S]*?)^```$/gm;
  const lines = [...text.matchAll(fence)].flatMap(([, block]) => block.split("\n"));
  const inline = [...text.replace(fence, "").matchAll(/`([^`]+)`/g)].map(([, span]) =>
    span.replace(/\s+/g, " "),
  );
  return [...lines, ...(spans ? inline : [])].map(bare).filter(isCommand);
}

const commands = new Set([
  ...commandsOf("CONTRIBUTING.md", { spans: true }),
  ...commandsOf("README.md", { spans: false }),
]);

const fits = (entry, command) =>
  entry.endsWith("*") ? command.startsWith(entry.slice(0, -1)) : command === entry;

const { scripts } = JSON.parse(readFileSync("package.json", "utf8"));
const manifest = readFileSync("Cargo.toml", "utf8");

/** Throws where a word of a command names nothing. */
function mustBe(there, sentence) {
  assert.ok(there, sentence);
}

function checkNode([file], options) {
  mustBe(existsSync(file), `${file} is not there`);
  const { status, stderr } = spawnSync(process.execPath, ["--check", file], { encoding: "utf8" });
  assert.equal(status, 0, stderr);
  const source = readFileSync(file, "utf8");
  for (const option of options) mustBe(source.includes(option), `${file} knows no ${option}`);
}

function checkNpm([verb, ...words], options) {
  const name = verb === "run" ? words[0] : verb;
  if (["ci", "install"].includes(verb)) return;
  mustBe(scripts[name], `package.json has no script "${name}": add it, or leave the command out`);
  for (const part of scripts[name].split("&&")) {
    const [program, ...rest] = bare(part).split(" ");
    const check = programs[program];
    if (check) check(rest, program === "node" ? options : []);
    else if (program !== "cp") checkBinary([program]);
  }
}

function checkBinary([name]) {
  mustBe(existsSync(join("node_modules/.bin", name)), `no npm package has a program "${name}"`);
}

let metadata;
/** What cargo knows of this workspace. */
function workspace() {
  if (metadata === undefined) {
    const args = ["metadata", "--no-deps", "--format-version", "1"];
    const { stdout, status, stderr } = spawnSync("cargo", args, { encoding: "utf8" });
    assert.equal(status, 0, stderr);
    metadata = JSON.parse(stdout).packages;
  }
  return metadata;
}

const targets = (kind) =>
  workspace().flatMap((one) => one.targets.filter(({ kind: all }) => all.includes(kind)));
const named = (list) => list.map(({ name }) => name);

/** What the value of each of cargo's options must be one of. */
const cargoNames = {
  package: () => named(workspace()),
  bin: () => named(targets("bin")),
  bench: () => named(targets("bench")),
  test: () => named(targets("test")),
  example: () => named(targets("example")),
  features: () => workspace().flatMap(({ features }) => Object.keys(features)),
  profile: () => [
    ...["dev", "release", "test", "bench"],
    ...[...manifest.matchAll(/^\[profile\.(\w+)\]/gm)].map(([, name]) => name),
  ],
};

const CARGOS_OWN = ["bench", "build", "clippy", "doc", "fetch", "fmt", "install", "run", "test"];

function checkCargo([verb, ...rest]) {
  if (!CARGOS_OWN.includes(verb)) {
    const install = [...commands].some((one) => /^cargo install/.test(one) && one.endsWith(verb));
    mustBe(install, `the document must also say how to get it: cargo install cargo-${verb}`);
    return;
  }
  const end = rest.includes("--") ? rest.indexOf("--") : rest.length;
  const [own, passed] = [rest.slice(0, end), rest.slice(end + 1)];
  for (const [place, word] of own.entries()) {
    const [option, value = own[place + 1]] = word.replace(/^-p$/, "--package").split("=");
    const known = cargoNames[option.replace(/^--/, "")];
    if (!option.startsWith("--") || !known) continue;
    mustBe(known().includes(value), `there is no ${option.slice(2)} "${value}"`);
  }
  if (verb === "run" && !own.some((word) => ["-p", "--package"].includes(word))) checkCli(passed);
}

/** Our own command line: the subcommand and the options, as its source has them. */
function checkCli([verb, ...rest]) {
  const folder = "src/bin/shapevenn";
  const read = (name) => readFileSync(join(folder, name), "utf8");
  const name = verb.charAt(0).toUpperCase() + verb.slice(1);
  const [, known = ""] = /^enum Command \{([\s\S]*?)^\}/m.exec(read("main.rs")) ?? [];
  mustBe(new RegExp(`^ {4}${name}\\b`, "m").test(known), `there is no subcommand "${verb}"`);
  const sources = readdirSync(folder).map(read).join("\n");
  for (const option of rest.filter((word) => word.startsWith("--"))) {
    const field = option.slice(2).replaceAll("-", "_");
    const is = new RegExp(`\\b${field}: |long = "${option.slice(2)}"`).test(sources);
    mustBe(is, `no subcommand has an option ${option}`);
  }
}

function checkPython([file]) {
  if (file.startsWith("-")) return;
  const there = [file, join("scripts", file)].some((path) => existsSync(path));
  mustBe(there, `${file} is neither at the top nor in scripts/`);
}

const programs = {
  npm: checkNpm,
  node: checkNode,
  cargo: checkCargo,
  npx: checkBinary,
  python3: checkPython,
};

for (const command of commands) {
  test(`\`${command}\` names what is there`, async () => {
    const entry = Object.keys(TRIED).find((one) => fits(one, command));
    mustBe(
      entry,
      `Nothing says how \`${command}\` is tried. Add it to TRIED in tests/unit/contributing.test.mjs.`,
    );
    const [program, ...words] = command.split(" ");
    // What follows `--` is for the script that npm runs.
    const own = words.filter((word) => word !== "--");
    const options = own.filter((word) => word.startsWith("--"));
    programs[program](program === "npm" ? own : words, options);
    const { execute } = TRIED[entry];
    if (execute === undefined) return;
    const { ok, output } = await attempt(program, words, { env: execute });
    assert.ok(ok, `\`${command}\` failed:\n${output}`);
  });
}

test("every entry has a command", () => {
  for (const entry of Object.keys(TRIED)) {
    mustBe(
      [...commands].some((command) => fits(entry, command)),
      `Neither CONTRIBUTING.md nor a block of README.md has \`${entry}\` any more. Take it out of TRIED.`,
    );
  }
});
