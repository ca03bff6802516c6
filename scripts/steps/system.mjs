/** System packages: installed only as root on Debian and its kin; sudo is never called. */
import { existsSync, readFileSync } from "node:fs";
import { attempt, must, StepError, step, which } from "./run.mjs";

/** `SETUP_DRY_RUN=1` prints the commands that change the machine instead of running them. */
export const dryRun = process.env.SETUP_DRY_RUN === "1";

/** Whether packages come from apt. */
export function isDebian() {
  if (process.platform !== "linux" || which("apt-get") === null) return false;
  const release = existsSync("/etc/os-release") ? readFileSync("/etc/os-release", "utf8") : "";
  return /^ID(_LIKE)?=.*\b(debian|ubuntu)\b/m.test(release);
}

export function isDebianRoot() {
  return isDebian() && process.getuid?.() === 0;
}

/** Runs a command that changes the machine: one announced step. */
export function change(what, program, args, { env, hint } = {}) {
  return step(what, () => {
    if (!dryRun) return must(program, args, { env, hint }).then(() => undefined);
    return `would run: ${[program, ...args].join(" ")}`;
  });
}

let updated = false;

/**
 * Installs Debian packages as root. Anyone else is told the one command to run; `elsewhere` is
 * the advice for systems without apt.
 */
export async function installPackages(packages, why, elsewhere) {
  const command = `apt-get install -y --no-install-recommends ${packages.join(" ")}`;
  if (!isDebian()) throw new StepError(`Missing: ${why}.`, elsewhere);
  if (!isDebianRoot()) {
    throw new StepError(`Missing: ${why}.`, `run this once as root, then try again: ${command}`);
  }
  const env = { DEBIAN_FRONTEND: "noninteractive" };
  await updateLists();
  await change(
    `Installing ${packages.join(", ")} (${why})`,
    "apt-get",
    ["install", "-y", "--no-install-recommends", ...packages],
    { env, hint: `find out what this says, then try again: ${command}` },
  );
}

/** Once: what the lists of a fresh machine have is old, or nothing. */
async function updateLists() {
  if (updated) return;
  await change("Updating the list of system packages", "apt-get", ["update"], {
    hint: "check the network and /etc/apt/sources.list, then try again.",
  });
  updated = true;
}

/** Whether apt knows all of these packages; after an `update`, where that is allowed. */
export async function aptOffers(packages, { update = true } = {}) {
  if (!isDebian()) return false;
  if (update && isDebianRoot()) await updateLists();
  for (const name of packages) {
    const { output } = await attempt("apt-cache", ["policy", name]);
    if (!/Candidate: (?!\(none\))/.test(output)) return false;
  }
  return true;
}
