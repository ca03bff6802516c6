/** Measures how long the parts of a frame take, for `npm run bench -- --morph` only. */

interface Timed {
  timings?: Record<string, number[]>;
  /** Whether each frame waits until it is drawn; other timings are not valid then. */
  timesDrawing?: boolean;
}

const page: Timed = globalThis as Timed;
const timings = page.timings ?? null;

export function timesDrawing(): boolean {
  return page.timesDrawing === true;
}

export function note(name: string, begun: number): void {
  if (timings === null) return;
  timings[name] ??= [];
  timings[name].push(performance.now() - begun);
}

/** Does some work and records its duration. */
export async function timed<T>(name: string, work: () => Promise<T>): Promise<T> {
  const begun = performance.now();
  const done = await work();
  note(name, begun);
  return done;
}
