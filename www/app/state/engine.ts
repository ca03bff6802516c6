/** Starts the engine's worker for the page. */
import { EngineClient } from "../../worker/client";
import { EngineFailure, sentenceOf } from "../../worker/engine-errors";
import { parseThreads, writeStart } from "../../worker/start";
import workerFile from "../../worker/worker.ts?worker&url";
import { engine, notify, type ShownNotice, spoken } from "./state";

const query = new URLSearchParams(location.search);
const restarted = new Set<() => void>();

let client: EngineClient | null = null;

export function engineClient(): EngineClient {
  client ??= new EngineClient(spawn, {
    onReady: (info) => {
      engine.value = info;
    },
    onRestart: (reason) => {
      engine.value = null;
      notify(
        "page",
        "engine-stopped",
        reason,
        "The engine is restarted and your models are opened again.",
      );
      for (const listener of restarted) listener();
    },
    onGiveUp: (reason) => {
      engine.value = null;
      notify(
        "page",
        "engine-gone",
        `The engine cannot be started: ${reason}`,
        "The stored comparison stays readable. Reload the page, or open it in another browser.",
      );
    },
  });
  return client;
}

/** Calls a function after each restart of the engine, which makes all handles invalid. */
export function onEngineRestart(listener: () => void): void {
  restarted.add(listener);
}

function spawn(serial: boolean): Worker {
  const start = writeStart({
    base: new URL(".", document.baseURI).href,
    serial: serial || query.has("serial"),
    threads: parseThreads(query.get("threads")),
  });
  try {
    return new Worker(new URL("../../worker/worker.ts", import.meta.url), {
      type: "module",
      name: start,
    });
  } catch (thrown) {
    if (globalThis.origin !== "null") throw thrown;
    return importingWorker(new URL(workerFile, document.baseURI).href, start);
  }
}

/**
 * A worker of a frame with the attribute `sandbox` and without `allow-same-origin`: the frame has an origin of its own,
 * to which every script is foreign, so that a worker can only begin with one that the page makes. Chromium starts no
 * module worker there; a classic one may import the module.
 */
function importingWorker(file: string, name: string): Worker {
  // What arrives before the module listens is handed on.
  const script = `
    const early = [];
    onmessage = ({ data }) => early.push(data);
    import(${JSON.stringify(file)}).then(
      () => early.forEach((data) => dispatchEvent(new MessageEvent("message", { data }))),
      (reason) => setTimeout(() => { throw reason; }),
    );`;
  const made = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
  return new Worker(made, { name });
}

/** Shows an error next to the part of the page that it concerns. */
export function report(
  place: ShownNotice["place"],
  thrown: unknown,
  again: ShownNotice["again"] = null,
  choose: ((reading: string) => void) | null = null,
): void {
  const failure =
    thrown instanceof EngineFailure
      ? thrown
      : { code: "unexpected", message: sentenceOf(thrown), hint: "" };
  if (failure.code === "engine-stopped" || failure.code === "superseded") return;
  const offered = choose && failure instanceof EngineFailure ? failure.choices : [];
  const choices = offered.map(({ label, reading }) => ({ label, act: () => choose?.(reading) }));
  notify(place, failure.code, failure.message, failure.hint, again, choices);
  spoken.value = `${failure.message} ${failure.hint}`;
}
