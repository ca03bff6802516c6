/** What the page tells the worker at its start, in the worker's name. */
export interface WorkerStart {
  /** Where the page is: the engine's packages lie relative to it. */
  base: string;
  /** Never try the build with threads. */
  serial: boolean;
  /** Development only: an engine that invents its numbers. */
  mock: boolean;
}

export function writeStart(start: WorkerStart): string {
  return JSON.stringify(start);
}

export function readStart(name: string): WorkerStart {
  const read = JSON.parse(name) as Partial<WorkerStart>;
  return { base: read.base ?? "/", serial: read.serial === true, mock: read.mock === true };
}
