/** Runs, restores and shows comparisons: whatever is chosen is what gets compared. */
import { batch, effect } from "@preact/signals";
import { wasAborted } from "../worker/engine-errors";
import type { Progress, Region, Report } from "../worker/protocol";
import { FIRST_DEMO } from "./demos";
import { engineClient, onEngineRestart, report as reportError } from "./engine";
import { REGIONS } from "./link";
import { plain } from "./phrase";
import {
  chosenPart,
  currentKey,
  dismiss,
  emptyRegions,
  failedKey,
  nouns,
  opening,
  type Result,
  result,
  run,
  settings,
  shapes,
  shapesSeed,
  slots,
  spoken,
} from "./state";
import type { Stored } from "./stored";
import { isCloud } from "./viewer/contents";
import { belief } from "./words";

/** How long the page waits for the next change before it runs. */
const SETTLE_MS = 500;
/** How often the picture is refined while running. */
const REFINE_MS = 1500;

let runController: AbortController | null = null;
let regionController = new AbortController();
let stored: Stored | null = null;
let restoring = false;
/** The engine holds this comparison, so that regions and files can be asked for. */
let heldKey: string | null = null;

/** Whenever what is chosen differs from what is shown, run it, once the changes settle. */
export function watchChoices(first: Stored | null): void {
  stored = first;
  let timer: ReturnType<typeof setTimeout> | undefined;
  effect(() => {
    const key = currentKey.value;
    const busy = opening.a.value !== null || opening.b.value !== null;
    clearTimeout(timer);
    if (key === null || busy || key === failedKey.value) return;
    if (key === result.value?.key && heldKey === key) return;
    if (stored?.key === key) timer = setTimeout(() => void restore(key), 0);
    else timer = setTimeout(() => void start(), SETTLE_MS);
  });
  onEngineRestart(() => {
    heldKey = null;
    restoring = false;
    run.value = null;
  });
}

/** Puts the stored comparison back: its numbers at once, its shapes when the engine has them. */
async function restore(key: string): Promise<void> {
  const [a, b] = [chosenPart("a"), chosenPart("b")];
  if (!stored || !a || !b || restoring) return;
  restoring = true;
  forgetRun();
  dismiss("run");
  try {
    const draws = (await stored.draws()).slice(0);
    result.value = storedResult(stored);
    const signal = new AbortController().signal;
    await engineClient().restore(signal, a.model, b.model, stored.text, draws);
    heldKey = key;
    await showRegions(REGIONS);
  } catch (thrown) {
    // A stored comparison that cannot be restored is no use: draw it again.
    stored = null;
    if (!wasAborted(thrown)) void start();
  } finally {
    restoring = false;
  }
}

export function storedResult(first: Stored): Result {
  const { report, text, key } = first;
  return { report, text, key, nouns: FIRST_DEMO.nouns, stored: true, cancelled: false };
}

export async function start(): Promise<void> {
  const [a, b] = [chosenPart("a"), chosenPart("b")];
  const key = currentKey.value;
  if (!a || !b || key === null) return;
  forgetRun();
  const controller = new AbortController();
  runController = controller;
  batch(() => {
    run.value = { progress: null, seconds: 0, cancelling: false };
    failedKey.value = null;
    dismiss("run");
    dismiss("page");
  });
  spoken.value = "Comparison started.";
  heldKey = null;
  const refine = refiner(key);
  const begun = performance.now();
  try {
    const done = await engineClient().run(
      controller.signal,
      a.model,
      b.model,
      settings.value,
      (progress, seconds) => {
        if (runController !== controller) return;
        run.value = { progress, seconds, cancelling: controller.signal.aborted };
        refine(progress, performance.now() - begun);
      },
    );
    if (runController !== controller) return;
    finish(key, done.report, done.cancelled);
    await showRegions(REGIONS);
  } catch (thrown) {
    if (runController !== controller) return;
    failedKey.value = key;
    reportError("run", thrown);
  } finally {
    if (runController === controller) {
      runController = null;
      run.value = null;
    }
  }
}

/** Ends the run and keeps what was drawn so far. */
export function cancel(): void {
  if (!run.value || !runController) return;
  run.value = { ...run.value, cancelling: true };
  runController.abort();
}

/** Forgets a run that the next request to the engine supersedes; a cancel would measure it first. */
function forgetRun(): void {
  runController = null;
  run.value = null;
}

function finish(key: string, text: string, cancelled: boolean): void {
  const report = JSON.parse(text) as Report;
  batch(() => {
    result.value = { report, text, key, nouns: nouns.value, stored: false, cancelled };
    run.value = null;
  });
  heldKey = key;
  const verdict = plain(belief(report).phrase);
  spoken.value = cancelled
    ? `Cancelled; the draws so far are kept. ${verdict}`
    : `Comparison finished. ${verdict}`;
}

/** Asks for shapes as soon as there are any, then again now and then, one question at a time. */
function refiner(key: string): (progress: Progress, now: number) => void {
  let asked = Number.NEGATIVE_INFINITY;
  let asking = false;
  return (progress, now) => {
    if (!progress.hasIntersection || asking || now - asked < REFINE_MS) return;
    const wanted: Region[] = asked < 0 ? ["intersection", "a", "b"] : ["intersection"];
    asking = true;
    asked = now;
    heldKey = key;
    showRegions(wanted).finally(() => {
      asking = false;
    });
  };
}

/** How many shapes of a region are asked for: a grid of surfaces, a heap of drawings, a cloud. */
export function shapeCount(): number {
  const geometry = slots.a.value?.geometry;
  if (geometry?.segments) return 60;
  return geometry && isCloud(geometry) ? 600 : 9;
}

async function showRegions(regions: Region[]): Promise<void> {
  if (regions.length === REGIONS.length) {
    regionController.abort();
    regionController = new AbortController();
  }
  const { signal } = regionController;
  const seed = shapesSeed.value;
  await Promise.all(
    regions.map(async (name) => {
      try {
        const found = await engineClient().region(signal, name, shapeCount(), seed);
        batch(() => {
          shapes.value = { ...shapes.value, [name]: found };
          const { [name]: _, ...others } = emptyRegions.value;
          emptyRegions.value = others;
        });
      } catch (thrown) {
        if (signal.aborted || wasAborted(thrown)) return;
        const why = thrown instanceof Error ? thrown.message : "There is nothing to show.";
        batch(() => {
          const { [name]: _, ...others } = shapes.value;
          shapes.value = others;
          emptyRegions.value = { ...emptyRegions.value, [name]: why };
        });
      }
    }),
  );
}

/** Other shapes of the same draws. */
export async function resample(): Promise<void> {
  shapesSeed.value = (BigInt(shapesSeed.value) + 1n).toString();
  await reshow();
}

export async function reshow(): Promise<void> {
  if (heldKey !== null) await showRegions(REGIONS);
}
