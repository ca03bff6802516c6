/**
 * Installs what is missing, and says each thing it does in one line. `npm run setup` gets ready
 * for `npm start`; with `-- --tests` also for `npm test`. SETUP_DRY_RUN=1 prints the commands
 * that change the machine instead of running them.
 */
import { existsSync, mkdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";
import { ask, attempt, cache, isMain, main, root, StepError, which } from "./steps/run.mjs";
import {
  aptOffers,
  change,
  dryRun,
  installPackages,
  isDebian,
  isDebianRoot,
} from "./steps/system.mjs";
import { ensureLinters, ensureRust, ensureWasm } from "./steps/toolchain.mjs";

/** What the Rust tests compare with. */
const pythonPackages = ["numpy", "scipy", "h5py", "h5json", "trimesh"];

/** Node itself, then the packages that the lock file names. */
export async function ensureNode() {
  const [major = 0, minor = 0] = process.versions.node.split(".").map(Number);
  if (major < 20 || (major === 20 && minor < 19)) {
    throw new StepError(
      `Node ${process.versions.node} is too old.`,
      "install Node 20.19 or later.",
    );
  }
  const lock = join(root, "package-lock.json");
  const stamp = join(root, "node_modules/.shapevenn-lock.json");
  const installed = join(root, "node_modules/.package-lock.json");
  const wanted = readFileSync(lock, "utf8");
  if (existsSync(stamp) && readFileSync(stamp, "utf8") === wanted) return;
  const newer = existsSync(installed) && statSync(installed).mtimeMs >= statSync(lock).mtimeMs;
  if (!newer) {
    await change(
      "Installing the npm packages",
      "npm",
      ["ci", "--no-audit", "--no-fund", "--loglevel=error"],
      {
        hint: "check the network; `npm ci` must succeed.",
      },
    );
  }
  if (!dryRun) writeFileSync(stamp, wanted);
}

const pythons = ["python3", "python"];
const findPython = () => pythons.find((name) => ask(name, "-c", "import venv, ensurepip") !== null);

/**
 * System packages, all in one command: a C compiler, since Rust links with it; for tests also a
 * Python that can make environments. On Debian as root a browser for the tests too; elsewhere
 * `ensureBrowser` fetches one.
 */
export async function ensureSystem({ tests = false } = {}) {
  if (process.platform === "win32") return;
  const missing = [];
  if (which("cc") === null) {
    const elsewhere =
      process.platform === "darwin" ? "run xcode-select --install" : "install gcc or clang";
    missing.push({ what: "a C compiler", packages: ["build-essential"], elsewhere });
  }
  if (tests && findPython() === undefined) {
    const elsewhere = "install Python 3.10 or later with venv";
    missing.push({ what: "Python with venv", packages: ["python3", "python3-venv"], elsewhere });
  }
  if (tests && isDebianRoot()) {
    const update = !findInstalledBrowser();
    if (update) {
      missing.push({ what: "a browser for the tests", packages: ["chromium"], elsewhere: "" });
    }
    if (!which(SHELL) && (await aptOffers([SHELL], { update }))) {
      missing.push({ what: "the same without a window", packages: [SHELL], elsewhere: "" });
    }
  }
  if (missing.length === 0) return;
  await installPackages(
    missing.flatMap(({ packages }) => packages),
    missing.map(({ what }) => what).join(", "),
    `${missing.map(({ elsewhere }) => elsewhere).join("; ")}; then try again.`,
  );
}

/** Everything that building needs; resolves to what builds the engine, see toolchain.mjs. */
export async function ensureBuild(options) {
  await ensureSystem();
  await ensureRust();
  return ensureWasm(options);
}

/**
 * Chromium without the window that nobody sees: the tests take a fifth less time. `CHROMIUM=/usr/bin/chromium` runs them in the
 * whole browser.
 */
const SHELL = "chromium-headless-shell";

function findInstalledBrowser() {
  const places = [
    process.env.CHROMIUM,
    which(SHELL),
    which("chromium"),
    which("chromium-browser"),
    which("google-chrome"),
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    join(process.env.PROGRAMFILES ?? homedir(), "Google/Chrome/Application/chrome.exe"),
  ];
  return places.find((place) => place && existsSync(place)) ?? null;
}

/** The browser that the tests drive: CHROMIUM, an installed one, or playwright's own. */
export async function findBrowser() {
  const installed = findInstalledBrowser();
  if (installed !== null) return installed;
  const { chromium } = await import("playwright-core");
  return existsSync(chromium.executablePath()) ? chromium.executablePath() : null;
}

/** On a machine without a browser, fetches one that needs no root. */
export async function ensureBrowser() {
  if ((await findBrowser()) !== null) return;
  const apt = isDebian() ? ` Or as root: apt-get install -y ${SHELL}` : "";
  await change(
    "Fetching Chromium for the browser tests",
    "npx",
    ["playwright-core", "install", "chromium"],
    { hint: `install Chromium or Chrome, or set CHROMIUM to its path.${apt}` },
  );
}

/** A Python with the packages that the Rust tests compare with; resolves to its path. */
export async function ensurePython() {
  const home = join(cache, "python");
  const python = join(home, process.platform === "win32" ? "Scripts/python.exe" : "bin/python");
  const complete = () => ask(python, "-c", `import ${pythonPackages.join(", ")}`) !== null;
  if (complete()) return python;
  const system = findPython();
  if (system === undefined && !dryRun) {
    throw new StepError(
      "No Python here can make environments.",
      "see above for how to install it.",
    );
  }
  mkdirSync(cache, { recursive: true });
  await change(
    "Making a Python environment",
    system ?? "python3",
    ["-m", "venv", "--clear", home],
    {
      hint: `delete ${home} and try again.`,
    },
  );
  await change(
    `Installing ${pythonPackages.join(", ")} into it`,
    python,
    ["-m", "pip", "install", "--quiet", ...pythonPackages],
    { hint: "check the network, then try again." },
  );
  return python;
}

/** nextest where it is installed already, else cargo's own runner. */
export async function hasNextest() {
  return (await attempt("cargo", ["nextest", "--version"])).ok;
}

export { ensureLinters, ensureRust, ensureWasm };

if (isMain(import.meta.url)) {
  await main(async () => {
    const tests = process.argv.includes("--tests");
    await ensureNode();
    await ensureSystem({ tests });
    await ensureBuild({ lint: tests });
    if (tests) {
      await ensureLinters();
      await ensureBrowser();
      await ensurePython();
    }
    console.log("Everything needed is here.");
  });
}
