/**
 * The engine as the page sees it: promises with an `AbortSignal` first.
 *
 * After a panic, out-of-memory or a hang the worker is dead; every promise rejects, a new worker
 * starts, and `onRestart` lets the page open its models again.
 */
import { EngineFailure } from "./engine-errors";
import type {
  Axes,
  AxesKind,
  ChainPlots,
  DifferenceShapes,
  Download,
  DroppedFile,
  Ellipsoid,
  Evaluation,
  Explored,
  FromEngine,
  Geometry,
  Group,
  Handle,
  Inspection,
  LessonAnswers,
  LessonAsk,
  MapName,
  Nearest,
  OpenedModel,
  Pairing,
  PairPlots,
  Placement,
  PointSelection,
  Preview,
  Progress,
  Region,
  RegionShapes,
  RelationReport,
  RunFile,
  Settings,
  Side,
  Sides,
  Space,
  SpecimenTable,
  SweepPoint,
  ToEngine,
  VertexMap,
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
  onProgress?: OnProgress;
  onRead?: OnRead;
}

type OnProgress = (progress: Progress, seconds: number, report?: string) => void;
type OnRead = (bytes: number, of: number) => void;

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

  async groups(signal: AbortSignal, files: DroppedFile[]): Promise<Group[]> {
    return (await this.#ask(signal, { t: "groups", files }, "groups")).groups;
  }

  async specimens(
    signal: AbortSignal,
    files: DroppedFile[],
    reading: string,
  ): Promise<SpecimenTable> {
    return (await this.#ask(signal, { t: "specimens", files, reading }, "specimens")).table;
  }

  /** Aborting gives the model up; the engine lets go of it when it is read. */
  async open(
    signal: AbortSignal,
    files: DroppedFile[],
    part: string | null,
    reading: string,
    onRead: OnRead,
  ): Promise<Reply<"opened">> {
    return this.#opened(signal, { t: "open", files, part, reading }, [], onRead);
  }

  async addShapes(
    signal: AbortSignal,
    model: Handle,
    files: DroppedFile[],
    name: string,
    reading: string,
  ): Promise<OpenedModel> {
    const request = { t: "addShapes", model, files, name, reading } as const;
    return (await this.#ask(signal, request, "shapesAdded")).opened;
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

  async inspect(
    signal: AbortSignal,
    a: Handle,
    b: Handle,
    settings: Partial<Settings>,
  ): Promise<Inspection> {
    return (await this.#ask(signal, { t: "inspect", a, b, settings }, "inspected")).inspection;
  }

  async points(signal: AbortSignal, text: string): Promise<PointSelection> {
    return (await this.#ask(signal, { t: "points", text }, "points")).points;
  }

  /** The two models as the current run compares them. */
  async compared(signal: AbortSignal): Promise<Sides<Geometry>> {
    const { a, b } = await this.#ask(signal, { t: "compared" }, "compared");
    return { a, b };
  }

  /** Aborting ends the run and still resolves, with what was drawn so far. */
  async run(
    signal: AbortSignal,
    a: Handle,
    b: Handle,
    settings: Partial<Settings>,
    onProgress: OnProgress,
  ): Promise<Reply<"done">> {
    const id = this.#next++;
    const cancel = () => this.#send({ t: "cancel", id });
    signal.addEventListener("abort", cancel);
    try {
      const reply = await this.#wait(id, { t: "run", id, a, b, settings }, [], { onProgress });
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
    picture: DifferenceShapes = "draws",
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

  async axes(signal: AbortSignal, space: Space, kind: AxesKind): Promise<Axes> {
    return (await this.#ask(signal, { t: "axes", space, kind }, "axes")).axes;
  }

  /** The shape so many standard deviations along each axis. */
  async explore(
    signal: AbortSignal,
    space: Space,
    kind: AxesKind,
    coefficients: readonly number[],
    follow: boolean,
  ): Promise<Explored> {
    const request = { t: "explore", space, kind, follow } as const;
    const along = Float64Array.from(coefficients);
    return (await this.#ask(signal, { ...request, coefficients: along }, "explored")).explored;
  }

  async nearestShapes(signal: AbortSignal, shape: Float32Array): Promise<Sides<Nearest>> {
    return (await this.#ask(signal, { t: "nearest", shape }, "nearest")).nearest;
  }

  async pairing(signal: AbortSignal, side: Side, place: number): Promise<Pairing> {
    return (await this.#ask(signal, { t: "pairing", side, place }, "pairing")).pairing;
  }

  /** The shape nearest to the one with these coefficients whose vertex is at the target. */
  async drag(
    signal: AbortSignal,
    space: Space,
    coefficients: ArrayLike<number>,
    vertex: number,
    target: readonly number[],
    follow: boolean,
  ): Promise<Explored> {
    const request = {
      t: "drag",
      space,
      coefficients: Float64Array.from(coefficients),
      vertex,
      target: Float64Array.from(target),
      follow,
    } as const;
    return (await this.#ask(signal, request, "explored")).explored;
  }

  async map(signal: AbortSignal, name: MapName, region: Region, mode = 0): Promise<VertexMap> {
    return (await this.#ask(signal, { t: "map", name, region, mode }, "map")).map;
  }

  async ellipsoids(
    signal: AbortSignal,
    vertex: number,
  ): Promise<Partial<Record<Region, Ellipsoid>>> {
    return (await this.#ask(signal, { t: "ellipsoids", vertex }, "ellipsoids")).ellipsoids;
  }

  async diagnose(signal: AbortSignal, side: "a" | "b", mode: number): Promise<ChainPlots> {
    return (await this.#ask(signal, { t: "diagnose", side, mode }, "diagnosed")).figures;
  }

  async pairs(
    signal: AbortSignal,
    side: "a" | "b",
    modes: number,
    most: number,
  ): Promise<PairPlots> {
    return (await this.#ask(signal, { t: "pairs", side, modes, most }, "pairs")).figures;
  }

  async relate(
    signal: AbortSignal,
    a: Handle,
    b: Handle,
    settings: Partial<Settings>,
  ): Promise<RelationReport> {
    return (await this.#ask(signal, { t: "relate", a, b, settings }, "related")).relation;
  }

  async evaluate(
    signal: AbortSignal,
    model: Handle,
    files: DroppedFile[],
    training: boolean,
    placement: Placement,
  ): Promise<Evaluation> {
    const request = { t: "evaluate", model, files, training, placement } as const;
    return (await this.#ask(signal, request, "evaluated")).evaluation;
  }

  async readRun(signal: AbortSignal, text: string): Promise<RunFile> {
    return (await this.#ask(signal, { t: "readRun", text }, "run")).run;
  }

  async runFile(signal: AbortSignal, sources: Sides<string | null>): Promise<string> {
    return (await this.#ask(signal, { t: "runFile", sources }, "runFile")).text;
  }

  /** One question of the lesson, and the answer of its kind. */
  async lesson<K extends LessonAsk["ask"]>(
    signal: AbortSignal,
    ask: Extract<LessonAsk, { ask: K }>,
  ): Promise<LessonAnswers[K]> {
    const { answer } = await this.#ask(signal, { t: "lesson", ask }, "lesson");
    return answer as LessonAnswers[K];
  }

  async export(signal: AbortSignal, what: Download): Promise<Reply<"exported">> {
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
    onRead?: OnRead,
  ): Promise<Reply<"opened">> {
    signal.throwIfAborted();
    const id = this.#next++;
    const aborted = new Promise<never>((_, reject) => {
      signal.addEventListener("abort", () => reject(signal.reason), { once: true });
    });
    const message = { ...request, id } as ToEngine;
    const reply = this.#wait(id, message, transfer, onRead ? { onRead } : {}).then((found) => {
      const opened = found as Reply<"opened">;
      if (signal.aborted) this.close(opened.model);
      return opened;
    });
    // Whoever gives it up need not wait for the engine to come to its end.
    return Promise.race([reply, aborted]);
  }

  async #ask<T extends FromEngine["t"]>(
    signal: AbortSignal,
    request: Request,
    _reply: T,
    transfer: Transferable[] = [],
  ): Promise<Reply<T>> {
    signal.throwIfAborted();
    const id = this.#next++;
    const reply = await this.#wait(id, { ...request, id } as ToEngine, transfer);
    signal.throwIfAborted();
    return reply as Reply<T>;
  }

  #wait(
    id: number,
    message: ToEngine,
    transfer: Transferable[],
    listeners: Pick<Pending, "onProgress" | "onRead"> = {},
  ): Promise<FromEngine> {
    return new Promise((resolve, reject) => {
      this.#pending.set(id, { resolve, reject, ...listeners });
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
        this.#pending
          .get(message.id)
          ?.onProgress?.(message.progress, message.seconds, message.report);
        break;
      case "reading":
        // Making the model of what was read is one piece of work.
        this.#watch.busy();
        this.#pending.get(message.id)?.onRead?.(message.bytes, message.of);
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
