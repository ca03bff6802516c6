/**
 * Owns one engine and answers the page. Plain functions of messages: the worker's entry hands it
 * an engine and a way to post, tests hand it others.
 *
 * A run is done in slices of about 50 ms with a macrotask between them, because a worker that is
 * busy reads no messages and would not see a cancel.
 */
import { isEngineError, sentenceOf } from "./engine-errors";
import type { Engine, FromEngine, RegionShapes, Stage, ToEngine } from "./protocol";
import { firstBudget, isIndivisible, nextBudget } from "./slices";

export type Post = (message: FromEngine, transfer?: Transferable[]) => void;

interface Run {
  id: number;
  begun: number;
  /** Milliseconds spent drawing. */
  drawing: number;
  budget: number;
  stage: Stage;
  posted: number;
}

const POST_EVERY_MS = 90;

export class Coordinator {
  #engine: Engine;
  #post: Post;
  #later: (work: () => void) => void;
  #run: Run | null = null;

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
        const { code, message, hint } = thrown;
        this.#post({ t: "error", id, code, message, hint: hint ?? "" });
      } else {
        this.#run = null;
        this.#post({ t: "fatal", message: sentenceOf(thrown) });
      }
    }
  }

  #answer(message: ToEngine): void {
    const engine = this.#engine;
    switch (message.t) {
      case "open": {
        this.#busy("reading the file");
        const opened = engine.open(message.name, new Uint8Array(message.bytes));
        return this.#post({ t: "opened", id: message.id, ...opened });
      }
      case "openDemo": {
        this.#busy("preparing the demo");
        const bytes = message.bytes === null ? undefined : new Uint8Array(message.bytes);
        const opened = engine.openDemo(message.demo, bytes);
        return this.#post({ t: "opened", id: message.id, ...opened });
      }
      case "geometry": {
        const geometry = engine.geometry(message.model);
        return this.#post({ t: "geometry", id: message.id, geometry }, buffersOf(geometry));
      }
      case "run":
        return this.#start(message.id, () => {
          engine.start(message.a, message.b, message.settings);
        });
      case "cancel":
        if (this.#run?.id !== message.id) return;
        engine.cancel();
        return this.#finish(this.#run, true);
      case "restore": {
        this.#supersede();
        this.#busy("restoring the comparison");
        engine.restore(message.a, message.b, message.report, new Uint8Array(message.draws));
        return this.#post({ t: "restored", id: message.id });
      }
      case "region": {
        this.#busy("drawing shapes");
        const shapes = engine.region(message.region, message.count, message.seed);
        return this.#post({ t: "region", id: message.id, shapes }, buffersOf(shapes));
      }
      case "export": {
        this.#busy("writing the file");
        const { name, mime, bytes } = engine.export(message.what);
        const own = bytes.slice().buffer;
        return this.#post({ t: "exported", id: message.id, name, mime, bytes: own }, [own]);
      }
      case "close":
        return engine.close(message.model);
    }
  }

  #start(id: number, begin: () => void): void {
    this.#supersede();
    this.#busy("preparing the comparison");
    const run: Run = {
      id,
      begun: performance.now(),
      drawing: 0,
      budget: firstBudget(),
      stage: "prepare",
      posted: 0,
    };
    begin();
    this.#run = run;
    this.#later(() => this.#slice(run));
  }

  /** A new run ends the one before it. */
  #supersede(): void {
    const run = this.#run;
    if (run === null) return;
    this.#run = null;
    this.#engine.cancel();
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
      run.budget = nextBudget(run.budget, now - begun);
      const changed = progress.stage !== run.stage;
      run.stage = progress.stage;
      if (progress.stage === "done") return this.#finish(run, false);
      if (changed || now - run.posted >= POST_EVERY_MS) {
        run.posted = now;
        const seconds = (now - run.begun) / 1000;
        this.#post({ t: "progress", id: run.id, progress, seconds });
      } else {
        this.#post({ t: "beat" });
      }
      this.#later(() => this.#slice(run));
    });
  }

  #finish(run: Run, cancelled: boolean): void {
    this.#busy("measuring");
    const total = (performance.now() - run.begun) / 1000;
    const report = this.#engine.report(total, run.drawing / 1000);
    this.#run = null;
    this.#post({ t: "done", id: run.id, cancelled, report });
  }

  #busy(what: string): void {
    this.#post({ t: "busy", what });
  }
}

/** Buffers of the typed arrays in a reply, to be transferred. */
function buffersOf(reply: object | RegionShapes): Transferable[] {
  const buffers = new Set<ArrayBuffer>();
  for (const value of Object.values(reply)) {
    if (ArrayBuffer.isView(value) && value.buffer instanceof ArrayBuffer) buffers.add(value.buffer);
  }
  return [...buffers];
}
