import assert from "node:assert/strict";
import { test } from "node:test";
import { EngineClient } from "./client";
import type { FromEngine, ToEngine } from "./protocol";

class FakeWorker {
  sent: ToEngine[] = [];
  ended = false;
  onmessage: ((event: { data: FromEngine }) => void) | null = null;
  onerror: (() => void) | null = null;
  postMessage(message: ToEngine) {
    this.sent.push(message);
  }
  terminate() {
    this.ended = true;
  }
  say(message: FromEngine) {
    this.onmessage?.({ data: message });
  }
  last(): ToEngine & { id: number } {
    return this.sent.at(-1) as ToEngine & { id: number };
  }
}

function begin() {
  const workers: (FakeWorker & { serial: boolean })[] = [];
  const events: string[] = [];
  const client = new EngineClient(
    (serial) => {
      const worker = Object.assign(new FakeWorker(), { serial });
      workers.push(worker);
      return worker as unknown as Worker;
    },
    {
      onReady: () => events.push("ready"),
      onRestart: () => events.push("restart"),
      onGiveUp: () => events.push("gone"),
    },
  );
  const worker = () => workers.at(-1) as FakeWorker & { serial: boolean };
  worker().say({ t: "ready", protocol: 1, build: "serial", threads: 1, engine: "0" });
  return { client, workers, worker, events };
}

const never = () => new AbortController().signal;

test("replies find their question", async () => {
  const { client, worker } = begin();
  const first = client.region(never(), "a", 1, "1");
  const { id } = worker().last();
  const second = client.export(never(), { kind: "report-json" });
  worker().say({ t: "exported", id: id + 1, name: "n", mime: "m", bytes: new ArrayBuffer(0) });
  assert.equal((await second).name, "n");
  worker().say({ t: "error", id, code: "nothing-yet", message: "Nothing yet.", hint: "Wait." });
  await assert.rejects(first, { code: "nothing-yet", hint: "Wait." });
  client.dispose();
});

test("aborting a run cancels it and still resolves with what was drawn", async () => {
  const { client, worker } = begin();
  const controller = new AbortController();
  const run = client.run(controller.signal, 1, 2, {}, () => {});
  const { id } = worker().last();
  controller.abort();
  assert.deepEqual(worker().last(), { t: "cancel", id });
  worker().say({ t: "done", id, cancelled: true, report: "{}" });
  assert.equal((await run).cancelled, true);
  client.dispose();
});

test("a model that nobody waits for any more is closed", async () => {
  const { client, worker } = begin();
  const controller = new AbortController();
  const files = [{ name: "x.h5", blob: new Blob(["x"]) }];
  const opening = client.open(controller.signal, files, null, "", () => {});
  const { id } = worker().last();
  controller.abort();
  await assert.rejects(opening, { name: "AbortError" });
  const opened = { format: "f", parts: ["shape"], model: 5, part: "shape", report: {} };
  worker().say({ t: "opened", id, ...opened } as unknown as FromEngine);
  await Promise.resolve();
  assert.deepEqual(worker().last(), { t: "close", model: 5 });
  client.dispose();
});

test("how far a file is read is told to whoever opens it", async () => {
  const { client, worker } = begin();
  const told: [number, number][] = [];
  const files = [{ name: "x.h5", blob: new Blob(["x"]) }];
  const opening = client.open(never(), files, "color", "", (...read) => told.push(read));
  const { id } = worker().last();
  worker().say({ t: "reading", id, bytes: 10, of: 40 });
  worker().say({ t: "reading", id: id + 1, bytes: 20, of: 40 });
  worker().say({ t: "opened", id, part: "color", model: 2 } as unknown as FromEngine);
  assert.equal((await opening).part, "color");
  assert.deepEqual(told, [[10, 40]]);
  client.dispose();
});

test("a relation that nobody waits for any more is dropped, the next one is answered", async () => {
  const { client, worker } = begin();
  const controller = new AbortController();
  const first = client.relate(controller.signal, 1, 2, {});
  const { id } = worker().last();
  controller.abort();
  const relation = { points: 12 } as unknown as Extract<FromEngine, { t: "related" }>["relation"];
  worker().say({ t: "related", id, relation });
  await assert.rejects(first, { name: "AbortError" });
  const second = client.relate(never(), 2, 1, {});
  assert.deepEqual(worker().last(), { t: "relate", id: id + 1, a: 2, b: 1, settings: {} });
  worker().say({ t: "related", id: id + 1, relation });
  assert.equal((await second).points, 12);
  client.dispose();
});

test("the text of a run file comes back as it was written", async () => {
  const { client, worker } = begin();
  const written = client.runFile(never(), { a: "demo:planes-a", b: null });
  const { id } = worker().last();
  worker().say({ t: "runFile", id, text: '{"shapevenn": 1}' });
  assert.equal(await written, '{"shapevenn": 1}');
  const read = client.readRun(never(), await written);
  assert.deepEqual(worker().last(), { t: "readRun", id: id + 1, text: '{"shapevenn": 1}' });
  worker().say({ t: "error", id: id + 1, code: "run-file", message: "No.", hint: "Choose." });
  await assert.rejects(read, { code: "run-file" });
  client.dispose();
});

test("after a panic every promise rejects and a new worker starts", async () => {
  const { client, worker, workers, events } = begin();
  const asked = client.region(never(), "b", 1, "1");
  worker().say({ t: "fatal", message: "unreachable" });
  await assert.rejects(asked, { code: "engine-stopped" });
  assert.equal(workers.length, 2);
  assert.equal(workers[0]?.ended, true);
  assert.deepEqual(events, ["ready", "restart"]);
  client.dispose();
});

test("a worker that cannot start with threads is tried without, then given up", () => {
  const { client, worker, workers, events } = begin();
  worker().say({ t: "fatal", message: "one" });
  worker().onerror?.();
  assert.equal(worker().serial, true);
  worker().onerror?.();
  worker().onerror?.();
  assert.equal(events.at(-1), "gone");
  assert.equal(workers.length, 4);
  client.dispose();
});
