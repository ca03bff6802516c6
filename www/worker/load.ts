/**
 * Loads the engine: on many threads where the page is cross-origin isolated, else alone in this worker. It is the
 * same file both times, in shared memory both times, which browsers give to any page.
 */
import type { Engine } from "./protocol";
import type { WorkerStart } from "./start";

/** What `wasm-bindgen --target web` makes of src/wasm.rs. */
interface EnginePackage {
  default(options: { memory: WebAssembly.Memory }): Promise<unknown>;
  Engine: { new (): Engine; version(): string };
  startThreads(threads: number): Promise<unknown>;
}

export interface Loaded {
  engine: Engine;
  build: "threads" | "serial";
  threads: number;
  version: string;
}

/** Threads that have not come up by then never will. */
const POOL_TIMEOUT_MS = 6000;

export async function loadEngine(start: WorkerStart): Promise<Loaded> {
  const threads = start.threads ?? navigator.hardwareConcurrency;
  // For one thread there need be no others, unless it is asked for by number.
  const wanted = !start.serial && (threads > 1 || start.threads !== null);
  if (!wanted || !globalThis.crossOriginIsolated) return alone(start.base);
  try {
    return await within(POOL_TIMEOUT_MS, withThreads(start.base, threads));
  } catch {
    // Whatever went wrong with threads: without them the results are the same. Not in the module that waits for
    // them, which they might join late.
    return alone(start.base, "?alone");
  }
}

async function withThreads(base: string, threads: number): Promise<Loaded> {
  const pack = await load(base);
  await pack.startThreads(threads);
  return { engine: new pack.Engine(), build: "threads", threads, version: pack.Engine.version() };
}

async function alone(base: string, query = ""): Promise<Loaded> {
  const pack = await load(base, query);
  return {
    engine: new pack.Engine(),
    build: "serial",
    threads: 1,
    version: pack.Engine.version(),
  };
}

/** An address with another `query` is another module, with memory of its own. */
async function load(base: string, query = ""): Promise<EnginePackage> {
  const memory = sharedMemory();
  const address = new URL(`engine/shapevenn.js${query}`, base).href;
  const pack = (await import(/* @vite-ignore */ address)) as EnginePackage;
  await pack.default({ memory });
  return pack;
}

/** Pages of 64 KiB that memory may grow to: all that the build can address, or what a phone allows. */
const CEILINGS = [65536, 32768, 16384, 8192];
/** Pages at the start; more than the build asks for. */
const FIRST_PAGES = 64;

/** Its ceiling is set aside at once, which phones refuse: a lower one may do. */
function sharedMemory(): WebAssembly.Memory {
  for (const maximum of CEILINGS) {
    try {
      return new WebAssembly.Memory({ initial: FIRST_PAGES, maximum, shared: true });
    } catch {
      // The next one.
    }
  }
  throw new Error(
    "This browser gives the engine no memory that it can use: Chrome and Edge do from version 91 on, Firefox from 89, " +
      "Safari from 16.4. Open the page in one of these, or close other tabs and reload it.",
  );
}

function within<T>(milliseconds: number, work: Promise<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => reject(new Error("timeout")), milliseconds);
    work.then(resolve, reject).finally(() => clearTimeout(timer));
  });
}
