/** Chooses between the two builds of the engine and loads one. */
import type { Engine } from "./protocol";
import type { WorkerStart } from "./start";

/** What `wasm-bindgen --target web` makes of src/wasm.rs. */
interface EnginePackage {
  default(options?: object): Promise<unknown>;
  Engine: { new (): Engine; version(): string };
  initThreadPool?(threads: number): Promise<unknown>;
}

export interface Loaded {
  engine: Engine;
  build: "threads" | "serial";
  threads: number;
  version: string;
}

/** A pool that has not come up by then never will; the build without threads does. */
const POOL_TIMEOUT_MS = 6000;

export async function loadEngine(start: WorkerStart): Promise<Loaded> {
  const threads = start.threads ?? navigator.hardwareConcurrency;
  // One thread is the serial build's, unless it is asked for by number.
  const wanted = !start.serial && (threads > 1 || start.threads !== null);
  const memory = wanted ? sharedMemory() : null;
  if (memory) {
    try {
      return await within(POOL_TIMEOUT_MS, loadThreads(start.base, threads, memory));
    } catch {
      // Whatever went wrong with threads, the serial build gives the same results.
    }
  }
  const serial = await importPackage(start.base, "serial");
  return {
    engine: new serial.Engine(),
    build: "serial",
    threads: 1,
    version: serial.Engine.version(),
  };
}

async function loadThreads(
  base: string,
  threads: number,
  memory: WebAssembly.Memory,
): Promise<Loaded> {
  const pack = await importPackage(base, "threads", { memory });
  await pack.initThreadPool?.(threads);
  return { engine: new pack.Engine(), build: "threads", threads, version: pack.Engine.version() };
}

async function importPackage(
  base: string,
  build: "threads" | "serial",
  options?: object,
): Promise<EnginePackage> {
  const address = new URL(`engine/${build}/shapevenn.js`, base).href;
  const pack = (await import(/* @vite-ignore */ address)) as EnginePackage;
  await pack.default(options);
  return pack;
}

/** Pages of 64 KiB that shared memory may grow to: what the build allows, or what a phone does. */
const CEILINGS = [32768, 16384];
/** Pages at the start; more than the build asks for. */
const FIRST_PAGES = 64;

/** Shared memory for the threads; null where there is none. Its ceiling is set aside at once, which phones refuse. */
function sharedMemory(): WebAssembly.Memory | null {
  if (!globalThis.crossOriginIsolated || typeof Worker === "undefined") return null;
  for (const maximum of CEILINGS) {
    try {
      // Safari has refused shared memory that its own checks promised, so try it.
      const memory = new WebAssembly.Memory({ initial: FIRST_PAGES, maximum, shared: true });
      if (memory.buffer instanceof SharedArrayBuffer) return memory;
    } catch {
      // A lower ceiling may do.
    }
  }
  return null;
}

function within<T>(milliseconds: number, work: Promise<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => reject(new Error("timeout")), milliseconds);
    work.then(resolve, reject).finally(() => clearTimeout(timer));
  });
}
