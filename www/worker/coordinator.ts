/**
 * Owns one engine and answers the page. Plain functions of messages: the worker's entry hands it
 * an engine and a way to post, tests hand it others.
 *
 * A run is done in slices of about 50 ms with a macrotask between them, because a worker that is
 * busy reads no messages and would not see a cancel.
 */
import { isEngineError, sentenceOf } from "./engine-errors";
import type { Engine, FromEngine, Handle, Notice, OpenedModel, Stage, ToEngine } from "./protocol";
import { firstBudget, isIndivisible, nextBudget } from "./slices";

export type Post = (message: FromEngine, transfer?: Transferable[]) => void;

interface Run {
  id: number;
  begun: number;
  /** Seconds spent reading the two models. */
  loading: number;
  /** Milliseconds spent drawing. */
  drawing: number;
  budget: number;
  evaluated: number;
  stage: Stage;
  posted: number;
}

/** Messages that are answered at once. */
type Question = Exclude<ToEngine, { t: "run" | "cancel" | "close" }>;

const BUSY_WITH: Record<Question["t"], string> = {
  groups: "looking at the files",
  open: "reading the file",
  addShapes: "reading the shapes",
  openDemo: "preparing the demo",
  geometry: "drawing the model",
  inspect: "looking at the pair",
  points: "reading the list",
  compared: "drawing the models",
  restore: "restoring the comparison",
  region: "drawing shapes",
  preview: "previewing",
  sweep: "trying other σ",
  export: "writing the file",
  axes: "ordering directions",
  explore: "drawing the shape",
  nearest: "finding the nearest shapes",
  pairing: "finding the nearest shapes",
  drag: "drawing the shape",
  map: "mapping the vertices",
  ellipsoids: "mapping the vertex",
  diagnose: "reading the draws",
  pairs: "reading the draws",
  relate: "relating the models",
  evaluate: "reading the shapes",
  specimens: "reading the specimens",
  readRun: "reading the run file",
  runFile: "writing the run file",
  lesson: "preparing the lesson",
};

const POST_EVERY_MS = 250;
/** Ten messages a second tell how far a file is read. */
const TELL_EVERY_MS = 100;

export class Coordinator {
  #engine: Engine;
  #post: Post;
  #later: (work: () => void) => void;
  #run: Run | null = null;
  /** Seconds that reading each model took. */
  #loading = new Map<Handle, number>();

  constructor(engine: Engine, post: Post, later: (work: () => void) => void) {
    this.#engine = engine;
    this.#post = post;
    this.#later = later;
  }

  receive(message: ToEngine): void {
    this.#guard("id" in message ? message.id : 0, () => this.#answer(message));
  }

  #guard(id: number, work: () => void): void {
    try {
      work();
    } catch (thrown) {
      if (this.#run?.id === id) this.#run = null;
      if (isEngineError(thrown)) {
        const { code, message, hint, choices } = thrown;
        const offered = choices ? { choices } : {};
        this.#post({ t: "error", id, code, message, hint: hint ?? "", ...offered });
      } else {
        this.#run = null;
        this.#post({ t: "fatal", message: sentenceOf(thrown) });
      }
    }
  }

  #answer(message: ToEngine): void {
    switch (message.t) {
      case "run":
        this.#start(message);
        break;
      case "cancel":
        if (this.#run?.id !== message.id) break;
        // The engine measures what there is before it returns.
        this.#busy("measuring");
        this.#engine.cancel();
        this.#finish(this.#run, true);
        break;
      case "close":
        this.#engine.close(message.model);
        this.#loading.delete(message.model);
        break;
      default: {
        this.#busy(BUSY_WITH[message.t]);
        const reply = this.#reply(message);
        this.#post(reply, buffersOf(reply));
      }
    }
  }

  #reply(message: Question): FromEngine {
    const engine = this.#engine;
    const { id } = message;
    switch (message.t) {
      case "groups":
        return { t: "groups", id, groups: engine.groups(message.files) };
      case "specimens": {
        const { files, reading } = message;
        return { t: "specimens", id, table: engine.specimens(files, reading) };
      }
      case "open": {
        const { files, part, reading } = message;
        const onRead = this.#teller(id);
        return this.#opened(id, () => engine.open(files, part ?? undefined, reading, onRead));
      }
      case "addShapes": {
        const { model, files, name, reading } = message;
        return { t: "shapesAdded", id, opened: engine.addShapes(model, files, name, reading) };
      }
      case "openDemo": {
        const bytes = message.bytes === null ? undefined : new Uint8Array(message.bytes);
        return this.#opened(id, () => engine.openDemo(message.demo, bytes));
      }
      case "geometry":
        return { t: "geometry", id, geometry: engine.geometry(message.model) };
      case "inspect": {
        const { a, b, settings } = message;
        return { t: "inspected", id, inspection: engine.inspect(a, b, settings) };
      }
      case "points":
        return { t: "points", id, points: engine.points(message.text) };
      case "compared":
        return { t: "compared", id, ...engine.compared() };
      case "restore":
        this.#supersede();
        engine.restore(message.a, message.b, message.report, new Uint8Array(message.draws));
        return { t: "restored", id };
      case "region": {
        const { region, count, seed, exaggeration, picture } = message;
        return {
          t: "region",
          id,
          shapes: engine.region(region, count, seed, exaggeration, picture),
        };
      }
      case "preview": {
        this.#refuseWhileRunning();
        return { t: "preview", id, ...engine.preview(message.sigma, message.count, message.seed) };
      }
      case "sweep":
        this.#refuseWhileRunning();
        return { t: "sweep", id, points: engine.sweep(message.sigmas) };
      case "axes":
        return { t: "axes", id, axes: engine.axes(message.space, message.kind) };
      case "explore": {
        const { space, kind, coefficients, follow } = message;
        return { t: "explored", id, explored: engine.explore(space, kind, coefficients, follow) };
      }
      case "nearest":
        return { t: "nearest", id, nearest: engine.nearestShapes(message.shape) };
      case "pairing":
        return { t: "pairing", id, pairing: engine.pairing(message.side, message.place) };
      case "drag": {
        const { space, coefficients, vertex, target, follow } = message;
        const explored = engine.drag(space, coefficients, vertex, target, follow);
        return { t: "explored", id, explored };
      }
      case "map":
        return { t: "map", id, map: engine.map(message.name, message.region, message.mode) };
      case "ellipsoids":
        return { t: "ellipsoids", id, ellipsoids: engine.ellipsoids(message.vertex) };
      case "diagnose":
        return { t: "diagnosed", id, figures: engine.diagnose(message.side, message.mode) };
      case "pairs": {
        const { side, modes, most } = message;
        return { t: "pairs", id, figures: engine.pairs(side, modes, most) };
      }
      case "relate": {
        const { a, b, settings } = message;
        return { t: "related", id, relation: engine.relate(a, b, settings) };
      }
      case "evaluate": {
        const { model, files, training, placement } = message;
        const evaluation = engine.evaluate(model, files, training, placement);
        return { t: "evaluated", id, evaluation };
      }
      case "readRun":
        return { t: "run", id, run: engine.readRun(message.text) };
      case "runFile":
        return { t: "runFile", id, text: engine.runFile(message.sources) };
      case "lesson":
        return { t: "lesson", id, answer: engine.lesson(message.ask) };
      case "export": {
        const { name, mime, bytes } = engine.export(message.what);
        // A copy of its own: what the engine hands out may be a view of its memory.
        return { t: "exported", id, name, mime, bytes: bytes.slice().buffer };
      }
    }
  }

  /** What only looks ahead must not hold up a run. */
  #refuseWhileRunning(): void {
    if (this.#run === null) return;
    throw {
      code: "running",
      message: "A comparison is running.",
      hint: "Ask again when it is done.",
    } satisfies Notice;
  }

  /** Says how far a file is read, now and then, and when all of it is. */
  #teller(id: number): (bytes: number, of: number) => void {
    let told = Number.NEGATIVE_INFINITY;
    return (bytes, of) => {
      const now = performance.now();
      if (now - told < TELL_EVERY_MS && bytes < of) return;
      told = now;
      this.#post({ t: "reading", id, bytes, of });
    };
  }

  #opened(id: number, open: () => OpenedModel): FromEngine {
    const begun = performance.now();
    const opened = open();
    const seconds = (performance.now() - begun) / 1000;
    this.#loading.set(opened.model, seconds);
    return { t: "opened", id, ...opened };
  }

  #start(message: Extract<ToEngine, { t: "run" }>): void {
    this.#supersede();
    this.#busy("preparing the comparison");
    const run: Run = {
      id: message.id,
      begun: performance.now(),
      loading: (this.#loading.get(message.a) ?? 0) + (this.#loading.get(message.b) ?? 0),
      drawing: 0,
      budget: firstBudget(),
      evaluated: 0,
      stage: "prepare",
      posted: 0,
    };
    this.#engine.start(message.a, message.b, message.settings);
    this.#run = run;
    this.#later(() => this.#slice(run));
  }

  /** A new run ends the one before it. */
  #supersede(): void {
    const run = this.#run;
    if (run === null) return;
    this.#run = null;
    this.#post({
      t: "error",
      id: run.id,
      code: "superseded",
      message: "Another run has begun.",
      hint: "",
    });
  }

  #slice(run: Run): void {
    if (this.#run !== run) return;
    this.#guard(run.id, () => {
      if (isIndivisible(run.stage)) this.#busy(run.stage);
      const begun = performance.now();
      const progress = this.#engine.advance(run.budget);
      const now = performance.now();
      if (run.stage === "intersection" || run.stage === "differences") run.drawing += now - begun;
      // Relabelling evaluates no distances: there the budget itself is what was done.
      const done = run.stage === "evidence" ? run.budget : progress.evaluations - run.evaluated;
      run.budget = nextBudget(run.budget, done, now - begun);
      run.evaluated = progress.evaluations;
      const changed = progress.stage !== run.stage;
      run.stage = progress.stage;
      // What an evaluation costs says nothing of a relabelling.
      if (changed && run.stage === "evidence") run.budget = firstBudget();
      if (progress.stage === "done") {
        this.#finish(run, false);
        return;
      }
      if (changed || now - run.posted >= POST_EVERY_MS) {
        run.posted = now;
        const seconds = (now - run.begun) / 1000;
        const known = changed && progress.stage === "evidence" && { report: this.#report(run) };
        this.#post({ t: "progress", id: run.id, progress, seconds, ...known });
      } else {
        this.#post({ t: "beat" });
      }
      this.#later(() => this.#slice(run));
    });
  }

  #finish(run: Run, cancelled: boolean): void {
    this.#busy("measuring");
    const report = this.#report(run);
    this.#run = null;
    this.#post({ t: "done", id: run.id, cancelled, report });
  }

  #report(run: Run): string {
    const total = (performance.now() - run.begun) / 1000;
    return this.#engine.report(total, run.drawing / 1000, run.loading);
  }

  #busy(what: string): void {
    this.#post({ t: "busy", what });
  }
}

/** Buffers that a reply may give away instead of copying, wherever in it they are. */
function buffersOf(reply: FromEngine): Transferable[] {
  const buffers = new Set<ArrayBuffer>();
  const search = (value: unknown) => {
    if (value instanceof ArrayBuffer) buffers.add(value);
    else if (ArrayBuffer.isView(value)) search(value.buffer);
    else if (typeof value === "object" && value !== null) Object.values(value).forEach(search);
  };
  search(reply);
  return [...buffers];
}
