/** How every script runs commands and says what it is doing: one line a step. */
import { spawn, spawnSync } from "node:child_process";
import { accessSync, existsSync, constants as files } from "node:fs";
import { constants, homedir, setPriority } from "node:os";
import { delimiter, dirname, join, resolve } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";

export const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");

/** Stamps, the Python environment, compiled unit tests. Safe to delete. */
export const cache = join(root, ".setup");

const windows = process.platform === "win32";

// rustup's installer puts its folder on the PATH of shells opened later.
const rustupHome = join(process.env.CARGO_HOME ?? join(homedir(), ".cargo"), "bin");
if (existsSync(rustupHome) && !(process.env.PATH ?? "").split(delimiter).includes(rustupHome)) {
  process.env.PATH = (process.env.PATH ?? "") + delimiter + rustupHome;
}

/** A step that failed, in one sentence, and what to do about it. */
export class StepError extends Error {
  constructor(message, hint, output = "") {
    super(message);
    this.hint = hint;
    this.output = output;
  }
}

/** The full path of a program, or null. */
export function which(program) {
  const endings = windows ? [".exe", ".cmd", ""] : [""];
  for (const folder of (process.env.PATH ?? "").split(delimiter)) {
    for (const ending of endings) {
      const path = join(folder, program + ending);
      try {
        accessSync(path, files.X_OK);
        return path;
      } catch {
        // Look on.
      }
    }
  }
  return null;
}

/**
 * On Windows only a shell starts npm and its like, which are scripts; it also takes arguments apart again, so that
 * programs are started without.
 */
function needsShell(program) {
  return windows && !/[\\/]/.test(program) && !(which(program) ?? "").endsWith(".exe");
}

/** What a quick command prints, trimmed; null when it fails or does not exist. */
export function ask(program, ...args) {
  const shell = needsShell(program);
  const result = spawnSync(program, args, { cwd: root, encoding: "utf8", shell });
  return result.status === 0 ? result.stdout.trim() : null;
}

/**
 * Runs a command to its end and keeps what it prints: all of it in `output`, what is meant for programs also in `stdout`.
 * Never throws. `onLine` gets each line as it comes. A variable of `env` that is undefined is taken away. `yielding`: only with what others leave of the processors.
 */
export function attempt(program, args, { env = {}, yielding = false, onLine } = {}) {
  return new Promise((done) => {
    const child = spawn(program, args, {
      cwd: root,
      env: { ...process.env, CARGO_TERM_COLOR: "never", ...env },
      shell: needsShell(program),
      stdio: ["ignore", "pipe", "pipe"],
    });
    if (yielding && child.pid) setPriority(child.pid, constants.priority.PRIORITY_LOW);
    let [output, stdout, stderr] = ["", "", ""];
    child.stdout.setEncoding("utf8").on("data", (chunk) => {
      output += chunk;
      stdout += chunk;
    });
    child.stderr.setEncoding("utf8").on("data", (chunk) => {
      output += chunk;
      stderr += chunk;
    });
    if (onLine) {
      for (const stream of [child.stdout, child.stderr]) {
        createInterface({ input: stream }).on("line", onLine);
      }
    }
    child.on("error", ({ message }) =>
      done({ ok: false, output: output + message, stdout, stderr }),
    );
    child.on("close", (code) => done({ ok: code === 0, output, stdout, stderr }));
  });
}

/** As `attempt`, but a failure is thrown with `hint`. */
export async function must(program, args, { env, hint, yielding } = {}) {
  const { ok, output } = await attempt(program, args, { env, yielding });
  if (!ok) throw new StepError(`\`${[program, ...args].join(" ")}\` failed.`, hint, output);
  return output;
}

let depth = 0;
let lineIsOpen = false;

/** Says what begins; the function it returns completes the line, or adds one after inner steps. */
export function announce(what) {
  const begin = performance.now();
  if (lineIsOpen) process.stdout.write("\n");
  process.stdout.write(`${"  ".repeat(depth)}→ ${what} … `);
  depth += 1;
  lineIsOpen = true;
  return (how) => {
    depth -= 1;
    const lead = lineIsOpen ? "" : `${"  ".repeat(depth)}  `;
    console.log(`${lead}${how} (${((performance.now() - begin) / 1000).toFixed(1)} s)`);
    lineIsOpen = false;
  };
}

/** A line below what is announced. */
export function note(line) {
  if (lineIsOpen) process.stdout.write("\n");
  lineIsOpen = false;
  console.log(`${"  ".repeat(depth + 1)}${line}`);
}

/** One announced step; the line ends with what `work` returns, or "done". */
export async function step(what, work) {
  const close = announce(what);
  try {
    const result = await work();
    close(typeof result === "string" ? result : "done");
    return result;
  } catch (error) {
    close("failed");
    throw error;
  }
}

/** Prints an error as every script does. */
export function explain(error) {
  if (!(error instanceof StepError)) {
    console.error(error);
    return;
  }
  if (error.output.trim() !== "") console.error(error.output.trimEnd());
  console.error(`\n${error.message}`);
  if (error.hint) console.error(`What to do: ${error.hint}`);
}

/** Whether this module is the one that node was started with. */
export function isMain(url) {
  return process.argv[1] !== undefined && resolve(process.argv[1]) === fileURLToPath(url);
}

/** Runs a script's main function; a failed step ends it with a sentence and exit code 1. */
export async function main(work) {
  try {
    await work();
  } catch (error) {
    explain(error);
    process.exit(1);
  }
}
