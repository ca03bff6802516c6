/**
 * A reporter for node's test runner: a line for each test as it ends, with what it took; where a terminal looks on, also which
 * runs now. At the end the slowest twenty, every failure in full, and the counts that node-tests.mjs reads.
 */
import { basename } from "node:path";

const SLOWEST = 20;
/** What the runner says of a test that `--test-name-pattern` leaves out. */
const UNNAMED = "test name does not match pattern";

const seconds = (milliseconds) => `${(milliseconds / 1000).toFixed(1).padStart(6)} s`;
const nameOf = ({ file, name }) => (file ? `${basename(file)}: ${name}` : name);

/** A file as a whole is no test, unless it fails before its first one. */
function isOfFile({ file, name, details }) {
  const ofTests = details?.error === undefined || details.error.failureType === "subtestsFailed";
  return file !== undefined && name === file && ofTests;
}

function lineOf({ name, milliseconds, passed, skipped }) {
  const how = passed ? (skipped ? "skipped: " : "") : "FAILED: ";
  return `${seconds(milliseconds)}  ${how}${name}\n`;
}

export default async function* report(events) {
  const ended = [];
  const said = [];
  for await (const { type, data } of events) {
    if (type === "test:pass" || type === "test:fail") {
      if (isOfFile(data)) continue;
      const passed = type === "test:pass";
      const skipped = data.skip !== undefined && data.skip !== false;
      if (data.skip === UNNAMED) continue;
      const milliseconds = data.details.duration_ms;
      ended.push({ name: nameOf(data), milliseconds, passed, skipped, data });
      yield lineOf(ended.at(-1));
    } else if (type === "test:start" && process.stdout.isTTY && !isOfFile(data)) {
      yield `\x1b[2K… ${nameOf(data)}\r`;
    } else if (type === "test:stderr") {
      said.push(data.message.trimEnd());
    }
  }
  yield* summary(ended, said);
}

function* summary(ended, said) {
  if (ended.length > SLOWEST) {
    yield `The slowest ${SLOWEST}:\n`;
    const sorted = ended.toSorted((one, other) => other.milliseconds - one.milliseconds);
    for (const one of sorted.slice(0, SLOWEST)) yield lineOf(one);
  }
  const failures = ended.filter(({ passed }) => !passed);
  for (const { name, data } of failures) {
    const { cause, message } = data.details.error ?? {};
    yield `\n✖ ${name}\n${data.file}:${data.line}\n${cause?.stack ?? cause ?? message}\n`;
  }
  if (failures.length > 0) yield said.map((line) => `  ${line}\n`).join("");
  yield `# pass ${ended.length - failures.length}\n# fail ${failures.length}\n`;
}
