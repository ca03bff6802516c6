/** How long parts of a frame take, for `npm run bench -- --morph`; nobody else asks. */

type Timings = Record<string, number[]>;

const timings = (globalThis as { timings?: Timings }).timings ?? null;

/** Whether somebody asks: some parts take time only because they are timed. */
export const isTimed = timings !== null;

export function note(name: string, begun: number): void {
  if (timings === null) return;
  timings[name] ??= [];
  timings[name].push(performance.now() - begun);
}

/** Does some work, and notes how long it took. */
export async function timed<T>(name: string, work: () => Promise<T>): Promise<T> {
  const begun = performance.now();
  const done = await work();
  note(name, begun);
  return done;
}
