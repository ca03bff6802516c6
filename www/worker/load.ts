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
  if (wanted && canShareMemory()) {
    try {
      return await within(POOL_TIMEOUT_MS, loadThreads(start.base, threads));
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

async function loadThreads(base: string, threads: number): Promise<Loaded> {
  const pack = await importPackage(base, "threads");
  await pack.initThreadPool?.(threads);
  return { engine: new pack.Engine(), build: "threads", threads, version: pack.Engine.version() };
}

async function importPackage(base: string, build: "threads" | "serial"): Promise<EnginePackage> {
  const address = new URL(`engine/${build}/shapevenn.js`, base).href;
  const pack = (await import(/* @vite-ignore */ address)) as EnginePackage;
  await pack.default();
  return pack;
}

/** Safari has refused shared memory that its own checks promised, so try it. */
function canShareMemory(): boolean {
  if (!globalThis.crossOriginIsolated) return false;
  if (typeof Worker === "undefined") return false;
  try {
    const memory = new WebAssembly.Memory({ initial: 1, maximum: 16384, shared: true });
    return memory.buffer instanceof SharedArrayBuffer;
  } catch {
    return false;
  }
}

function within<T>(milliseconds: number, work: Promise<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => reject(new Error("timeout")), milliseconds);
    work.then(resolve, reject).finally(() => clearTimeout(timer));
  });
}
