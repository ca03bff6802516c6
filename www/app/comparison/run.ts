/** Runs a comparison when models or settings change, restores the stored one, and requests the shapes to draw. */
import { batch, computed, effect } from "@preact/signals";
import { wasAborted } from "../../worker/engine-errors";
import type { Progress, Region, Report, Sides, SweepPoint } from "../../worker/protocol";
import { demoSource, sourceText } from "../models/sources";
import { FIRST_DEMO } from "../state/demos";
import { engineClient, onEngineRestart, report as reportError } from "../state/engine";
import { latest } from "../state/latest";
import { selectsPoints } from "../state/preparation";
import { isDifference, REGIONS } from "../state/regions";
import {
  canPreview,
  compared,
  currentBase,
  currentKey,
  dismiss,
  emptyRegions,
  exaggeration,
  failedKey,
  geometry,
  held,
  inspected,
  nouns,
  opening,
  pairKey,
  picture,
  preview,
  type Result,
  result,
  run,
  settings,
  shapes,
  shapesSeed,
  slots,
  spoken,
  storedGeometry,
  tried,
} from "../state/state";
import type { Stored } from "../state/stored";
import { plain } from "../text/phrase";
import { isCloud } from "../viewer/contents";
import { belief } from "./words";

/** Milliseconds without a change after which a comparison starts. */
const SETTLE_MS = 500;
/** Milliseconds between two requests for shapes during a run. */
const REFINE_MS = 1500;
/** Milliseconds of a run before which no shapes are requested: a shorter run shows its result only. */
const FIRST_GUESS_MS = 800;

type Held = NonNullable<typeof held.value>;

let runController: AbortController | null = null;
let regionController = new AbortController();
let stored: Stored | null = null;
let restoring = false;

/** Starts a comparison when the chosen models and settings differ from the shown ones and stop changing. */
export function watchChoices(first: Stored | null): void {
  stored = first;
  let timer: ReturnType<typeof setTimeout> | undefined;
  effect(() => {
    const key = currentKey.value;
    const busy = opening.a.value !== null || opening.b.value !== null;
    clearTimeout(timer);
    if (key === null || busy || key === failedKey.value) return;
    if (key === result.value?.key && held.peek()?.key === key) return;
    if (stored?.key === key) {
      timer = setTimeout(() => void restore(key), 0);
      return;
    }
    // A pair that cannot be compared is not run: the pair card says why, and what helps.
    const pair = inspected.value;
    if (pair?.key !== pairKey.value) return;
    if (pair?.inspection.problem) {
      giveUp();
      return;
    }
    timer = setTimeout(() => void start(), SETTLE_MS);
  });
  onEngineRestart(() => {
    held.value = null;
    restoring = false;
    run.value = null;
  });
}

/** Shows the stored comparison: its numbers at once, its shapes when the engine has restored them. */
async function restore(key: string): Promise<void> {
  const [a, b] = [slots.a.value, slots.b.value];
  if (!stored || !a || !b || restoring) return;
  const base = currentBase.value;
  restoring = true;
  forgetRun();
  dismiss("run");
  try {
    const draws = (await stored.draws()).slice(0);
    preview.value = null;
    result.value = storedResult(stored);
    const signal = new AbortController().signal;
    await engineClient().restore(signal, a.model, b.model, stored.text, draws);
    held.value = { key, base, selects: false };
    await showRegions(REGIONS);
    restoring = false;
  } catch (thrown) {
    restoring = false;
    // Other models were opened meanwhile: the stored comparison is kept for the first ones.
    if (slots.a.peek() !== a || slots.b.peek() !== b) {
      if (currentKey.peek() === key) void restore(key);
      return;
    }
    // A stored comparison that cannot be restored is run again.
    stored = null;
    if (!wasAborted(thrown)) void start();
  }
}

export function storedResult(first: Stored): Result {
  const { report, text, key } = first;
  const sources = {
    a: sourceText(demoSource(FIRST_DEMO.a)),
    b: sourceText(demoSource(FIRST_DEMO.b)),
  };
  return { report, text, key, sources, nouns: FIRST_DEMO.nouns, stored: true, cancelled: false };
}

export async function start(): Promise<void> {
  const [a, b] = [slots.a.value, slots.b.value];
  const key = currentKey.value;
  if (!a || !b || key === null) return;
  const running: Held = {
    key,
    base: currentBase.value,
    selects: selectsPoints(settings.value.prepare),
  };
  const sources = { a: sourceText(a.source), b: sourceText(b.source) };
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
  held.value = null;
  const restoreShapes = keepShapes();
  const refine = refiner(running);
  const begun = performance.now();
  let early: Report | null = null;
  try {
    const done = await engineClient().run(
      controller.signal,
      a.model,
      b.model,
      settings.value,
      (progress, seconds, known) => {
        if (runController !== controller) return;
        run.value = { progress, seconds, cancelling: controller.signal.aborted };
        // The report stands while what chance would give is still computed.
        if (known !== undefined) {
          early = show(running, parsed(known, false), sources);
          void showRegions(REGIONS);
        } else if (early === null) {
          refine(progress, performance.now() - begun);
        }
      },
    );
    if (runController !== controller) return;
    const found = parsed(done.report, done.cancelled);
    const { draws } = found.report.intersection.diagnostics;
    if (done.cancelled && draws === 0 && result.value !== null) {
      failedKey.value = key;
      restoreShapes();
      spoken.value = "Cancelled before there were any draws. The previous result is still shown.";
      return;
    }
    finish(running, { ...found, report: withKnownParts(found.report, early) }, sources);
    if (early === null) await showRegions(REGIONS);
  } catch (thrown) {
    if (runController !== controller) return;
    failedKey.value = key;
    restoreShapes();
    reportError("run", thrown);
  } finally {
    if (runController === controller) {
      runController = null;
      run.value = null;
    }
  }
}

/** Keeps the shapes of the shown result; returns a function that shows them again after a failed run. */
function keepShapes(): () => void {
  const [drawn, empty, points] = [shapes.value, emptyRegions.value, compared.value];
  return () =>
    batch(() => {
      preview.value = null;
      held.value = null;
      shapes.value = drawn;
      emptyRegions.value = empty;
      compared.value = points;
      comparedKey = null;
    });
}

/** Ends the run and keeps what was drawn so far. */
export function cancel(): void {
  if (!run.value || !runController) return;
  run.value = { ...run.value, cancelling: true };
  runController.abort();
}

/** Drops a run without cancelling it: the next request to the engine replaces it, a cancel would measure it first. */
function forgetRun(): void {
  runController = null;
  run.value = null;
}

/** Cancels a run of models that are no longer compared, without waiting for its result. */
function giveUp(): void {
  const controller = runController;
  forgetRun();
  controller?.abort();
}

interface Reported {
  report: Report;
  /** The report as text. */
  text: string;
  cancelled: boolean;
}

function parsed(text: string, cancelled: boolean): Reported {
  return { report: JSON.parse(text) as Report, text, cancelled };
}

/** Shows the numbers of a run. */
function show(
  ran: Held,
  { report, text, cancelled }: Reported,
  sources: Sides<string | null>,
): Report {
  const { key } = ran;
  batch(() => {
    preview.value = null;
    held.value = ran;
    result.value = { report, text, key, sources, nouns: nouns.value, stored: false, cancelled };
  });
  return report;
}

/** The parts that are found after the report of a run stands: its evidence, and what is said of it. */
const FOUND_LATER = ["answer", "evidence", "seconds"] as const;

/** A report with all parts of the one that the same run gave before but those, so that what shows them stays as it is. */
function withKnownParts(report: Report, before: Report | null): Report {
  if (!before) return report;
  const later = FOUND_LATER.map((part) => [part, report[part]]);
  return { ...before, ...Object.fromEntries(later) };
}

function finish(ran: Held, done: Reported, sources: Sides<string | null>): void {
  const { cancelled } = done;
  const report = batch(() => {
    run.value = null;
    return show(ran, done, sources);
  });
  const verdict = plain(belief(report).phrase);
  spoken.value = cancelled
    ? `Cancelled; the draws so far are kept. ${verdict}`
    : `Comparison finished. ${verdict}`;
}

/** Returns a function that requests shapes during a run: the first as soon as there are draws, then at intervals. */
function refiner(running: Held): (progress: Progress, now: number) => void {
  let asked = Number.NEGATIVE_INFINITY;
  let asking = false;
  let wait = REFINE_MS;
  return (progress, now) => {
    if (!progress.hasIntersection || asking) return;
    if (now < FIRST_GUESS_MS || now - asked < wait) return;
    const wanted: Region[] = asked < 0 ? ["intersection", "a", "b"] : ["intersection"];
    asking = true;
    asked = now;
    held.value = running;
    const begun = performance.now();
    showRegions(wanted).finally(() => {
      asking = false;
      // Shapes of a large model take the engine seconds: at most a tenth of a run is spent on them.
      wait = Math.max(REFINE_MS, 10 * (performance.now() - begun));
    });
  };
}

/** How many random shapes of a region are requested: few surfaces side by side, many outlines or points overlaid. */
export function shapeCount(): number {
  const { a } = geometry.value;
  if (a?.segments) return 60;
  return a && isCloud(a) ? 600 : 9;
}

async function showRegions(regions: Region[]): Promise<void> {
  if (regions.length === REGIONS.length) {
    regionController.abort();
    regionController = new AbortController();
  }
  const { signal } = regionController;
  const seed = shapesSeed.value;
  await showCompared(signal);
  await Promise.all(
    regions.map(async (name) => {
      try {
        const found = await engineClient().region(
          signal,
          name,
          shapeCount(),
          seed,
          exaggeration.value,
          picture.value,
        );
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
  if (regions.length === REGIONS.length && !signal.aborted) storedGeometry.value = null;
}

/** Key of the comparison whose points are in `compared`. */
let comparedKey: string | null = null;

/** Requests the compared points, if they are a selection of the models' points. */
async function showCompared(signal: AbortSignal): Promise<void> {
  const shown = held.value;
  if (shown === null || (shown.key === comparedKey && compared.value !== null)) return;
  if (!shown.selects) {
    compared.value = null;
    return;
  }
  try {
    const found = await engineClient().compared(signal);
    if (signal.aborted || held.value?.key !== shown.key) return;
    comparedKey = shown.key;
    compared.value = found;
  } catch (thrown) {
    if (!signal.aborted && !wasAborted(thrown)) reportError("run", thrown);
  }
}

/** Shows other random shapes of the same draws. */
export function resample(): void {
  shapesSeed.value = (BigInt(shapesSeed.value) + 1n).toString();
}

/** Requests other shapes of the same draws when the seed, the exaggeration or the kind of difference changes. */
export function watchPictures(): void {
  let drawn = shapesSeed.value;
  const show = latest<undefined>(() => {
    const others = shapesSeed.peek() !== drawn;
    drawn = shapesSeed.peek();
    return showRegions(others ? REGIONS : REGIONS.filter(isDifference));
  });
  const picked = computed(() => `${picture.value} ${exaggeration.value} ${shapesSeed.value}`);
  let shown = picked.value;
  effect(() => {
    if (picked.value === shown) return;
    shown = picked.value;
    if (held.peek() !== null) show(undefined);
  });
}

/** Whether the preview of another σ is still wanted: not after the slider was reset. */
let wantsPreview = false;

const askPreview = latest(async (sigma: number) => {
  const before = held.value;
  if (!canPreview.value) return;
  try {
    const { signal } = regionController;
    const found = await engineClient().preview(signal, sigma, shapeCount(), shapesSeed.value);
    // A run that started meanwhile shows its own shapes.
    if (!wantsPreview || !canPreview.value || held.value !== before) return;
    batch(() => {
      preview.value = found.prediction;
      shapes.value = { ...shapes.value, intersection: found.shapes };
    });
  } catch (thrown) {
    // If the fit fails there is no preview; the run reports the error.
    if (!wasAborted(thrown)) preview.value = null;
  }
});

/** Previews A∩B at another σ: shapes and predicted numbers of the Gaussian fit. */
export function trySigma(sigma: number): void {
  tried.value = sigma;
  wantsPreview = true;
  askPreview(sigma);
}

/** Sets σ to the previewed value, which starts a run; or ends the preview if σ is unchanged. */
export function takeSigma(sigma: number | null): void {
  tried.value = null;
  if (sigma !== settings.value.sigma) {
    settings.value = { ...settings.value, sigma };
    return;
  }
  wantsPreview = false;
  preview.value = null;
  if (canPreview.value) void showRegions(["intersection"]);
}

/** The numbers of A∩B at one σ by the Gaussian fit alone; null if the fit fails. */
export async function sweepPoint(signal: AbortSignal, sigma: number): Promise<SweepPoint | null> {
  return (await engineClient().sweep(signal, [sigma]))[0] ?? null;
}
