import assert from "node:assert/strict";
import { test } from "node:test";
import { Coordinator } from "./coordinator";
import type { Engine, FromEngine, Progress } from "./protocol";
import { nextBudget, SLICE_MS } from "./slices";

/** An engine that is done after `slices` slices, and the messages that its coordinator posts. */
function begin(slices: number, change: Partial<Engine> = {}) {
  const posted: FromEngine[] = [];
  const waiting: (() => void)[] = [];
  let left = slices;
  const engine = {
    start() {},
    cancel() {},
    close() {},
    advance: () => progress(--left <= 0 ? "done" : "intersection"),
    report: () => "{}",
    ...change,
  } as Engine;
  const coordinator = new Coordinator(
    engine,
    (message) => posted.push(message),
    (work) => waiting.push(work),
  );
  const step = () => waiting.shift()?.();
  const kinds = () => posted.map(({ t }) => t);
  return { coordinator, posted, step, kinds };
}

function progress(stage: Progress["stage"]): Progress {
  return {
    stage,
    fraction: 0.5,
    evaluations: 1,
    draws: 1,
    acceptance: null,
    rHatMax: null,
    essBulkMin: null,
    sigma: null,
    hasIntersection: false,
  };
}

const run = { t: "run", id: 7, a: 1, b: 2, settings: {} } as const;

test("a run is done in slices, with a macrotask between them", () => {
  const { coordinator, step, kinds } = begin(2);
  coordinator.receive(run);
  assert.deepEqual(kinds(), ["busy"]);
  step();
  assert.ok(kinds().includes("progress"));
  step();
  assert.equal(kinds().at(-1), "done");
});

test("a cancel between two slices ends the run with a report", () => {
  let cancelled = 0;
  const { coordinator, step, posted } = begin(100, { cancel: () => void cancelled++ });
  coordinator.receive(run);
  step();
  coordinator.receive({ t: "cancel", id: 7 });
  assert.equal(cancelled, 1);
  assert.deepEqual(posted.at(-1), { t: "done", id: 7, cancelled: true, report: "{}" });
  const before = posted.length;
  step();
  assert.equal(posted.length, before, "no slice after the cancel");
});

test("slices of relabelling take more at a time when they are fast", () => {
  const budgets: number[] = [];
  const { coordinator, step } = begin(0, {
    advance: (budget) => {
      budgets.push(budget);
      return progress(budgets.length < 2 ? "intersection" : "evidence");
    },
  });
  coordinator.receive(run);
  for (let slice = 0; slice < 8; slice += 1) step();
  const [, , first, second] = budgets;
  assert.equal(first, 64, "what an evaluation costs is forgotten");
  assert.equal(second, 256, "although no distance was evaluated");
});

test("a cancel of another run changes nothing", () => {
  const { coordinator, step, kinds } = begin(1);
  coordinator.receive(run);
  coordinator.receive({ t: "cancel", id: 6 });
  step();
  assert.equal(kinds().at(-1), "done");
});

test("a second run supersedes the first", () => {
  const { coordinator, posted } = begin(5);
  coordinator.receive(run);
  coordinator.receive({ ...run, id: 8 });
  const error = posted.find((message) => message.t === "error");
  assert.equal(error?.t === "error" && error.id === 7 && error.code, "superseded");
});

test("an error of the engine is answered with its code, a panic is fatal", () => {
  const refused = begin(1, {
    start: () => {
      throw {
        code: "point-count-mismatch",
        message: "A has 3 points, B has 4.",
        hint: "Same template.",
      };
    },
  });
  refused.coordinator.receive(run);
  assert.deepEqual(refused.posted.at(-1), {
    t: "error",
    id: 7,
    code: "point-count-mismatch",
    message: "A has 3 points, B has 4.",
    hint: "Same template.",
  });
  const dead = begin(1, {
    advance: () => {
      throw new Error("unreachable");
    },
  });
  dead.coordinator.receive(run);
  dead.step();
  assert.deepEqual(dead.posted.at(-1), { t: "fatal", message: "unreachable" });
});

test("previews and sweeps are answered, but not while a run goes on", () => {
  const prediction = { sigma: 1 };
  const shapes = { mean: new Float32Array(3) };
  const { coordinator, posted } = begin(5, {
    preview: () => ({ prediction, shapes }) as ReturnType<Engine["preview"]>,
    sweep: (sigmas) => [...sigmas].map((sigma) => ({ sigma })) as ReturnType<Engine["sweep"]>,
  });
  const preview = { t: "preview", id: 1, sigma: 1, count: 9, seed: "1" } as const;
  const sweep = { t: "sweep", id: 2, sigmas: Float64Array.of(1, 2) } as const;
  coordinator.receive(preview);
  assert.deepEqual(posted.at(-1), { t: "preview", id: 1, prediction, shapes });
  coordinator.receive(sweep);
  assert.deepEqual(posted.at(-1), { t: "sweep", id: 2, points: [{ sigma: 1 }, { sigma: 2 }] });
  coordinator.receive(run);
  for (const message of [preview, sweep]) {
    coordinator.receive(message);
    const error = posted.at(-1);
    assert.equal(error?.t === "error" && error.id === message.id && error.code, "running");
  }
});

test("a question of the lesson is answered, also while a run goes on, and its arrays are given away", () => {
  const posted: [FromEngine, Transferable[] | undefined][] = [];
  const values = new Float32Array(4);
  const engine = {
    start() {},
    lesson: (ask) => ({ ...ask, values, highest: 0, lowest: 0 }),
  } as Partial<Engine> as Engine;
  const coordinator = new Coordinator(
    engine,
    (message, transfer) => posted.push([message, transfer]),
    () => {},
  );
  coordinator.receive(run);
  const ask = { ask: "field", of: "prior", modes: [0, 1], extent: 3, size: 2 } as const;
  coordinator.receive({ t: "lesson", id: 9, ask: { ...ask, modes: [0, 1] } });
  assert.deepEqual(posted.at(-2), [{ t: "busy", what: "preparing the lesson" }, undefined]);
  const [message, transfer] = posted.at(-1) ?? [];
  assert.ok(message?.t === "lesson" && message.id === 9);
  assert.ok("values" in message.answer && message.answer.values === values);
  assert.deepEqual(transfer, [values.buffer]);
});

const files = [{ name: "set/1.ply", blob: new Blob(["x"]) }];

test("while a file is read the page hears how far, ten times a second and at the end", () => {
  const { coordinator, posted, kinds } = begin(1, {
    open: (_files, _part, _reading, onRead) => {
      for (let bytes = 1; bytes <= 1000; bytes += 1) onRead(bytes, 1000);
      return { model: 4, parts: ["shape"], part: "shape" } as ReturnType<Engine["open"]>;
    },
  });
  coordinator.receive({ t: "open", id: 3, files, part: null, reading: "" });
  const told = posted.flatMap((message) => (message.t === "reading" ? [message.bytes] : []));
  assert.equal(told[0], 1);
  assert.equal(told.at(-1), 1000);
  assert.ok(told.length < 20, `${told.length} messages`);
  assert.equal(kinds().at(-1), "opened");
});

test("a part, a size and the files themselves come to the engine as they were asked for", () => {
  const asked: unknown[][] = [];
  const { coordinator, posted } = begin(1, {
    open: (...given) => {
      asked.push(given.slice(0, 3));
      return { model: 1 } as ReturnType<Engine["open"]>;
    },
    groups: (given) => given.map(({ name }, i) => ({ name, files: [i], leftOut: [] })),
  });
  coordinator.receive({ t: "open", id: 1, files, part: "expression", reading: "scale" });
  coordinator.receive({ t: "open", id: 2, files, part: null, reading: "" });
  assert.deepEqual(asked, [
    [files, "expression", "scale"],
    [files, undefined, ""],
  ]);
  coordinator.receive({ t: "groups", id: 3, files });
  const groups = [{ name: "set/1.ply", files: [0], leftOut: [] }];
  assert.deepEqual(posted.at(-1), { t: "groups", id: 3, groups });
});

test("a pair is looked at while a run goes on", () => {
  const inspection = { problem: null } as ReturnType<Engine["inspect"]>;
  const { coordinator, posted, step, kinds } = begin(2, { inspect: () => inspection });
  coordinator.receive(run);
  coordinator.receive({ t: "inspect", id: 8, a: 1, b: 2, settings: {} });
  assert.deepEqual(posted.at(-1), { t: "inspected", id: 8, inspection });
  step();
  step();
  assert.equal(kinds().at(-1), "done");
});

test("lists of points are read by the engine, and its refusal is passed on", () => {
  const points = { by: "region", ranges: "1,2" } as const;
  const refusal = { code: "point-list", message: "Line 2 is no number.", hint: "Mend it." };
  const { coordinator, posted } = begin(1, {
    points: (text) => {
      if (text === "1\n2") return points;
      throw refusal;
    },
  });
  coordinator.receive({ t: "points", id: 1, text: "1\n2" });
  assert.deepEqual(posted.at(-1), { t: "points", id: 1, points });
  coordinator.receive({ t: "points", id: 2, text: "1\nx" });
  assert.deepEqual(posted.at(-1), { t: "error", id: 2, ...refusal });
});

test("any two open models are related, while a run goes on too", () => {
  const asked: unknown[][] = [];
  const relation = { varianceOfAInB: 0.5 } as ReturnType<Engine["relate"]>;
  const { coordinator, posted } = begin(5, {
    relate: (...given) => {
      asked.push(given);
      return relation;
    },
  });
  coordinator.receive(run);
  const settings = { align: "rigid" } as const;
  coordinator.receive({ t: "relate", id: 9, a: 4, b: 2, settings });
  assert.deepEqual(asked, [[4, 2, settings]]);
  assert.deepEqual(posted.at(-1), { t: "related", id: 9, relation });
});

test("a run file is written with where its models are from, and read as text", () => {
  const sources = { a: "demo:planes-a", b: null };
  const read = { models: {}, settings: {} } as unknown as ReturnType<Engine["readRun"]>;
  const refusal = { code: "run-file", message: "The file is no JSON.", hint: "Choose another." };
  const { coordinator, posted } = begin(1, {
    runFile: (given) => JSON.stringify(given),
    readRun: (text) => {
      if (text === "{}") return read;
      throw refusal;
    },
  });
  coordinator.receive({ t: "runFile", id: 1, sources });
  assert.deepEqual(posted.at(-1), { t: "runFile", id: 1, text: JSON.stringify(sources) });
  coordinator.receive({ t: "readRun", id: 2, text: "{}" });
  assert.deepEqual(posted.at(-1), { t: "run", id: 2, run: read });
  coordinator.receive({ t: "readRun", id: 3, text: "{" });
  assert.deepEqual(posted.at(-1), { t: "error", id: 3, ...refusal });
});

test("the meshes of a run are given away, both of them", () => {
  const given: Transferable[][] = [];
  const geometry = () => ({ mean: new Float32Array(3), vertexSd: new Float32Array(1) });
  const engine = { compared: () => ({ a: geometry(), b: geometry() }) } as unknown as Engine;
  const coordinator = new Coordinator(
    engine,
    (_, transfer = []) => given.push(transfer),
    () => {},
  );
  coordinator.receive({ t: "compared", id: 1 });
  assert.equal(given.at(-1)?.length, 4);
});

test("the region asked for is the one the engine is asked for", () => {
  const asked: unknown[][] = [];
  const { coordinator } = begin(1, {
    region: (...given) => {
      asked.push(given);
      return { samples: new Float32Array(0) } as ReturnType<Engine["region"]>;
    },
  });
  const request = { region: "aWithoutB", count: 9, seed: "4" } as const;
  const shown = { exaggeration: 1.5, picture: "exclusiveModes" } as const;
  coordinator.receive({ t: "region", id: 1, ...request, ...shown });
  assert.deepEqual(asked, [["aWithoutB", 9, "4", 1.5, "exclusiveModes"]]);
});

test("arrays are given away, not copied", () => {
  const given: Transferable[][] = [];
  const samples = new Float32Array(3);
  const region = {
    region: "a",
    mean: samples,
    vertexSd: new Float32Array(1),
    samples,
    count: 1,
    source: "draws",
  };
  const engine = { region: () => region } as unknown as Engine;
  new Coordinator(
    engine,
    (_, transfer = []) => given.push(transfer),
    () => {},
  ).receive({
    t: "region",
    id: 1,
    region: "a",
    count: 1,
    seed: "1",
    exaggeration: 0,
    picture: "draws",
  });
  assert.equal(given.at(-1)?.length, 2, "a buffer that is shared is given once");
});

test("the budget of a slice settles where a slice takes the wanted time", () => {
  let budget = 64;
  const perEvaluation = 0.31;
  for (let i = 0; i < 20; i += 1) budget = nextBudget(budget, budget, budget * perEvaluation);
  assert.ok(Math.abs(budget * perEvaluation - SLICE_MS) < 1);
  assert.equal(nextBudget(1, 1, 5000), 1, "never less than one");
});

test("work without evaluations leaves the budget alone", () => {
  // Regression: it grew while the run was prepared, and the first slice of sampling took 20 s.
  assert.equal(nextBudget(64, 0, 0.1), 64);
  assert.equal(nextBudget(64, 64, 0.001), 256, "grows no more than fourfold at a time");
});
