/** Entry of the engine’s worker: loads the engine, then hands every message to the coordinator. */
import { Coordinator } from "./coordinator";
import { sentenceOf } from "./engine-errors";
import { loadEngine } from "./load";
import { type FromEngine, PROTOCOL, type ToEngine } from "./protocol";
import { readStart, type WorkerStart } from "./start";

interface WorkerScope {
  readonly name: string;
  onmessage: ((event: MessageEvent<ToEngine>) => void) | null;
  postMessage(message: FromEngine, transfer: Transferable[]): void;
}

const scope = self as unknown as WorkerScope;
const post = (message: FromEngine, transfer: Transferable[] = []) =>
  scope.postMessage(message, transfer);

// Messages that come before the engine is there wait here.
const waiting: ToEngine[] = [];
scope.onmessage = (event) => waiting.push(event.data);

begin(readStart(scope.name)).catch((thrown: unknown) => {
  post({ t: "fatal", message: sentenceOf(thrown) });
});

async function begin(start: WorkerStart): Promise<void> {
  const { engine, build, threads, version } = await loadEngine(start);
  const coordinator = new Coordinator(engine, post, macrotasks());
  post({ t: "ready", protocol: PROTOCOL, build, threads, engine: version });
  scope.onmessage = (event) => coordinator.receive(event.data);
  for (const message of waiting) coordinator.receive(message);
}

/** Macrotasks without the 4 ms that nested timers are held back. */
function macrotasks(): (work: () => void) => void {
  const channel = new MessageChannel();
  const queue: (() => void)[] = [];
  channel.port1.onmessage = () => queue.shift()?.();
  return (work) => {
    queue.push(work);
    channel.port2.postMessage(null);
  };
}
