/** What the page tells the worker at its start, in the worker's name. */
export interface WorkerStart {
  /** Where the page is: the engine's packages lie relative to it. */
  base: string;
  /** One thread, whatever the page may have. */
  serial: boolean;
  /** How many threads; null for as many as the machine has. */
  threads: number | null;
}

const MOST_THREADS = 64;

/** A number of threads as it is typed; null for what is none. */
export function parseThreads(text: string | null): number | null {
  const threads = /^\d{1,2}$/.test(text ?? "") ? Number(text) : 0;
  return threads >= 1 && threads <= MOST_THREADS ? threads : null;
}

export function writeStart(start: WorkerStart): string {
  return JSON.stringify(start);
}

export function readStart(name: string): WorkerStart {
  const read = JSON.parse(name) as Partial<WorkerStart>;
  return {
    base: read.base ?? "/",
    serial: read.serial === true,
    threads: read.threads ?? null,
  };
}
