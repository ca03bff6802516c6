/**
 * The engine as the page sees it: promises with an `AbortSignal` first.
 *
 * After a panic, out-of-memory or a hang the worker is dead; every promise rejects, a new worker
 * starts, and `onRestart` lets the page open its models again.
 */
import { EngineFailure } from "./engine-errors";
import type {
  ExportKind,
  FromEngine,
  Geometry,
  Handle,
  Picture,
  Preview,
  Progress,
  Region,
  RegionShapes,
  Settings,
  SweepPoint,
  ToEngine,
} from "./protocol";
import { Watch } from "./watch";

export interface EngineInfo {
  build: "threads" | "serial";
  threads: number;
  version: string;
}

export interface EngineEvents {
  onReady(info: EngineInfo): void;
  /** The worker was replaced: every handle is void. */
  onRestart(reason: string): void;
  /** It could not be replaced either. */
  onGiveUp(reason: string): void;
}

interface Pending {
  resolve(message: FromEngine): void;
  reject(reason: unknown): void;
  onProgress?: (progress: Progress, seconds: number) => void;
}

type Request = ToEngine extends infer M
  ? M extends { id: number }
    ? Omit<M, "id">
    : never
  : never;
type Reply<T extends FromEngine["t"]> = Extract<FromEngine, { t: T }>;

const MOST_RESTARTS = 3;

export class EngineClient {
  #spawn: (serial: boolean) => Worker;
  #events: EngineEvents;
  #worker: Worker;
  #watch: Watch;
  #pending = new Map<number, Pending>();
  #next = 1;
  #restarts = 0;
  #ready = false;
  #serial = false;

  constructor(spawn: (serial: boolean) => Worker, events: EngineEvents) {
    this.#spawn = spawn;
    this.#events = events;
    this.#watch = new Watch(
      () => this.#pending.size > 0 || !this.#ready,
      () => this.#replace("The engine stopped answering."),
    );
    this.#worker = this.#begin();
  }

  async open(signal: AbortSignal, name: string, bytes: ArrayBuffer): Promise<Reply<"opened">> {
    return this.#opened(signal, { t: "open", name, bytes }, [bytes]);
  }

  async openDemo(
    signal: AbortSignal,
    demo: string,
    bytes: ArrayBuffer | null,
  ): Promise<Reply<"opened">> {
    return this.#opened(signal, { t: "openDemo", demo, bytes }, bytes === null ? [] : [bytes]);
  }

  async geometry(signal: AbortSignal, model: Handle): Promise<Geometry> {
    return (await this.#ask(signal, { t: "geometry", model }, "geometry")).geometry;
  }

  /** Aborting ends the run and still resolves, with what was drawn so far. */
  async run(
    signal: AbortSignal,
    a: Handle,
    b: Handle,
    settings: Partial<Settings>,
    onProgress: (progress: Progress, seconds: number) => void,
  ): Promise<Reply<"done">> {
    const id = this.#next++;
    const cancel = () => this.#send({ t: "cancel", id });
    signal.addEventListener("abort", cancel);
    try {
      const reply = await this.#wait(id, { t: "run", id, a, b, settings }, [], onProgress);
      return reply as Reply<"done">;
    } finally {
      signal.removeEventListener("abort", cancel);
    }
  }

  async restore(
    signal: AbortSignal,
    a: Handle,
    b: Handle,
    report: string,
    draws: ArrayBuffer,
  ): Promise<void> {
    await this.#ask(signal, { t: "restore", a, b, report, draws }, "restored", [draws]);
  }

  async region(
    signal: AbortSignal,
    region: Region,
    count: number,
    seed: string,
    exaggeration = 0,
    picture: Picture = "draws",
  ): Promise<RegionShapes> {
    const request = { t: "region", region, count, seed, exaggeration, picture } as const;
    return (await this.#ask(signal, request, "region")).shapes;
  }

  async preview(signal: AbortSignal, sigma: number, count: number, seed: string): Promise<Preview> {
    return this.#ask(signal, { t: "preview", sigma, count, seed }, "preview");
  }

  async sweep(signal: AbortSignal, sigmas: number[]): Promise<SweepPoint[]> {
    const request = { t: "sweep", sigmas: Float64Array.from(sigmas) } as const;
    return (await this.#ask(signal, request, "sweep")).points;
  }

  async export(signal: AbortSignal, what: ExportKind): Promise<Reply<"exported">> {
    return this.#ask(signal, { t: "export", what }, "exported");
  }

  close(model: Handle): void {
    this.#send({ t: "close", model });
  }

  dispose(): void {
    this.#watch.stop();
    this.#worker.terminate();
  }

  async #opened(
    signal: AbortSignal,
    request: Request,
    transfer: Transferable[],
  ): Promise<Reply<"opened">> {
    return this.#ask(signal, request, "opened", transfer, (late) => {
      for (const part of late.parts) this.close(part.model);
    });
  }

  /** `discard` tidies up after a reply that nobody waits for any more. */
  async #ask<T extends FromEngine["t"]>(
    signal: AbortSignal,
    request: Request,
    _reply: T,
    transfer: Transferable[] = [],
    discard?: (late: Reply<T>) => void,
  ): Promise<Reply<T>> {
    signal.throwIfAborted();
    const id = this.#next++;
    const reply = await this.#wait(id, { ...request, id } as ToEngine, transfer);
    if (signal.aborted) discard?.(reply as Reply<T>);
    signal.throwIfAborted();
    return reply as Reply<T>;
  }

  #wait(
    id: number,
    message: ToEngine,
    transfer: Transferable[],
    onProgress?: (progress: Progress, seconds: number) => void,
  ): Promise<FromEngine> {
    return new Promise((resolve, reject) => {
      const pending: Pending = { resolve, reject };
      if (onProgress) pending.onProgress = onProgress;
      this.#pending.set(id, pending);
      this.#send(message, transfer);
    });
  }

  #send(message: ToEngine, transfer: Transferable[] = []): void {
    this.#worker.postMessage(message, transfer);
  }

  #begin(): Worker {
    const worker = this.#spawn(this.#serial);
    this.#ready = false;
    this.#watch.busy();
    worker.onmessage = (event: MessageEvent<FromEngine>) => this.#receive(event.data);
    // A worker that is blocked or fails to load says nothing more than that.
    worker.onerror = () => {
      if (!this.#ready) this.#serial = true;
      this.#replace("The engine could not be started.");
    };
    return worker;
  }

  #receive(message: FromEngine): void {
    this.#watch.heard();
    switch (message.t) {
      case "ready": {
        this.#ready = true;
        const { build, threads, engine } = message;
        this.#events.onReady({ build, threads, version: engine });
        break;
      }
      case "beat":
        break;
      case "busy":
        this.#watch.busy();
        break;
      case "fatal":
        this.#replace(message.message);
        break;
      case "progress":
        this.#restarts = 0;
        this.#pending.get(message.id)?.onProgress?.(message.progress, message.seconds);
        break;
      case "error":
        this.#settle(message.id)?.reject(new EngineFailure(message));
        break;
      default:
        this.#settle(message.id)?.resolve(message);
    }
  }

  #settle(id: number): Pending | undefined {
    const pending = this.#pending.get(id);
    this.#pending.delete(id);
    return pending;
  }

  #replace(reason: string): void {
    this.#worker.terminate();
    const failure = new EngineFailure({
      code: "engine-stopped",
      message: reason,
      hint: "The engine was started again and your models are being opened anew.",
    });
    for (const pending of this.#pending.values()) pending.reject(failure);
    this.#pending.clear();
    this.#restarts += 1;
    if (this.#restarts > MOST_RESTARTS) {
      this.#watch.stop();
      this.#events.onGiveUp(reason);
      return;
    }
    this.#worker = this.#begin();
    this.#events.onRestart(reason);
  }
}
