/** Repeats the comparison of a run file, as soon as its models are open. */
import { batch, computed, effect, signal } from "@preact/signals";
import { wasAborted } from "../../../worker/engine-errors";
import type { DroppedFile, Side } from "../../../worker/protocol";
import { looksLikeAddress } from "../../models/address/address";
import { openPair } from "../../models/opening";
import {
  baseName,
  demoSource,
  first,
  isOpen,
  nameOf,
  sourceText,
  wantedOf,
} from "../../models/sources";
import { DEMO_MODELS } from "../../state/demos";
import { engineClient, report } from "../../state/engine";
import {
  currentKey,
  dismiss,
  engine,
  modelList,
  opening,
  result,
  SIDES,
  type Slot,
  settings,
  slots,
  spoken,
  type Wanted,
} from "../../state/state";
import { currentStep, joinStep } from "../../state/undo";
import { saveText } from "../../ui/download";
import { take } from "../history";
import type { LinkState } from "../link";
import { expectedByLink } from "../waiting";
import {
  adviceOf,
  type ExpectedModel,
  type ExpectedRun,
  expectedRun,
  firstDifference,
  LARGEST_RUN,
  looksLikeRun,
  type OpenModel,
  verdictOf,
} from "./expected";

/** The run file whose models are not both open yet. */
export const awaited = signal<ExpectedRun | null>(null);
/** The run file whose settings are in use. */
const taken = signal<{ run: ExpectedRun; key: string | null; same: boolean } | null>(null);

export const repeated = computed(() => {
  const found = taken.value;
  return found && found.key === currentKey.value ? found.run : null;
});

/** Whether its models are the same ones, too. */
export const sameModels = computed(() => taken.value?.same ?? false);

/** Path of the first number of the result that differs from the report, null if none does; undefined if unknown. */
export const reproduced = computed(() => {
  const [run, shown] = [repeated.value, result.value];
  if (!run?.report || !shown || shown.key !== taken.value?.key) return undefined;
  return firstDifference(run.report, shown.report);
});

/** What to do about each model before the run can start. */
export const advice = computed(() => {
  const run = awaited.value;
  const kind = run?.link ? "link" : "run file";
  const of = (side: Side) => (run ? adviceOf(run.models[side], openAs(side), side, kind) : null);
  return { a: of("a"), b: of("b") };
});

function openAs(side: Side): OpenModel | null {
  const slot = slots[side].value;
  return slot && { report: slot.report, source: sourceText(slot.source) };
}

/** The run file among these files, with its text. */
export async function runAmong(
  files: DroppedFile[],
): Promise<{ file: DroppedFile; text: string } | null> {
  for (const file of files) {
    if (!/\.json$/i.test(file.name) || file.blob.size > LARGEST_RUN) continue;
    const text = await file.blob.text();
    if (looksLikeRun(text)) return { file, text };
  }
  return null;
}

/** Opens a run file. If its models are opened too, only its settings and expectations are read. */
export async function openRun(name: string, text: string, models: boolean): Promise<void> {
  dismiss("page");
  try {
    const { signal } = new AbortController();
    const read = await engineClient().readRun(signal, text);
    const run = expectedRun(baseName(name), text, read, engine.value?.version ?? "");
    await awaitRun(run, models);
  } catch (thrown) {
    if (!wasAborted(thrown)) report("page", thrown);
  }
}

/** Waits for the models, and opens those that can be fetched unless other models are opened. */
async function awaitRun(run: ExpectedRun, models = false): Promise<void> {
  awaited.value = run;
  taken.value = null;
  if (!models) await openPair(fetchable(run, "a"), fetchable(run, "b"));
}

/** Waits for the visitor's own files that a link names; null if it names none. */
export function awaitLink(link: LinkState): Promise<void> | null {
  const run = expectedByLink(link);
  // An earlier link is no longer waited for.
  if (awaited.peek()?.link) awaited.value = null;
  return run && awaitRun(run);
}

/** Opens the models whose source the run file states, unless they are open. */
function fetchable(run: ExpectedRun, side: Side): Wanted | null {
  const { source, part, reading } = run.models[side];
  const demo = /^demo:(.+)/.exec(source ?? "")?.[1];
  const slot = slots[side].value;
  let wanted: Wanted | null = null;
  if (demo !== undefined) wanted = DEMO_MODELS.includes(demo) ? first(demoSource(demo)) : null;
  else if (source && looksLikeAddress(source)) {
    wanted = { source: { kind: "url", url: source }, part, reading };
  }
  return wanted && slot && isOpen(slot, wanted) ? null : wanted;
}

/** Starts the waiting run when its models are open. */
export function watchRunFile(): void {
  /** The step of the history before its models were opened. */
  let waitedAt: number | null = null;
  effect(() => {
    const run = awaited.value;
    const busy = opening.a.value !== null || opening.b.value !== null;
    const { a, b } = { a: openAs("a"), b: openAs("b") };
    if (run === null) waitedAt = null;
    if (run === null || busy) return;
    // After the step that opened the models is saved.
    queueMicrotask(() => {
      if (awaited.peek() !== run) return;
      if (isSame(run.models.a, a) && isSame(run.models.b, b)) {
        // Opening the models and starting the run are undone together.
        takeOver(run, waitedAt === null ? null : waitedAt + 1);
      } else {
        waitedAt = currentStep();
        if (opening.a.peek() === null && opening.b.peek() === null) void takeFromModelList(run);
      }
    });
  });
  effect(() => {
    const sentences = Object.values(advice.value).flatMap((sentence) => sentence ?? []);
    if (sentences.length > 0) spoken.value = sentences.join(" ");
  });
}

function isSame(expected: ExpectedModel, open: OpenModel | null): boolean {
  return verdictOf(expected, open) === "same";
}

/** Finds the expected models elsewhere: on the model list, with A and B exchanged, or as another part of their file. */
async function takeFromModelList(run: ExpectedRun): Promise<void> {
  const found = (side: Side): Wanted | null => {
    const expected = run.models[side];
    if (isSame(expected, openAs(side)) || expected.fingerprint === null) return null;
    const open = (slot: Slot) => ({ report: slot.report, source: null });
    const slot = modelList.value.find((one) => isSame(expected, open(one)));
    return slot ? wantedOf(slot) : otherwise(expected);
  };
  const [a, b] = [found("a"), found("b")];
  const complete = SIDES.every(
    (side) => isSame(run.models[side], openAs(side)) || (side === "a" ? a : b) !== null,
  );
  if (complete && (a || b)) await openPair(a, b);
}

/** The expected part of an open file of that name, of which other parts are open, or the same part read otherwise. */
function otherwise({ name, part, reading }: ExpectedModel): Wanted | null {
  if (name === null) return null;
  const files = modelList.value.filter(({ source }) => nameOf(source) === name);
  const wanted = (slot: Slot) => part ?? slot.part;
  const file = files.find((slot) => slot.parts.includes(wanted(slot)));
  const asExpected = (slot: Slot) => slot.part === wanted(slot) && slot.reading === reading;
  if (!file || files.some(asExpected)) return null;
  return { ...wantedOf(file), part: wanted(file), reading };
}

/** Applies its settings, as part of a step of undo or as a step of their own. */
function takeOver(run: ExpectedRun, step: number | null, same = true): void {
  const change = () => {
    if (run.link) take(run.link);
    else settings.value = run.settings;
    awaited.value = null;
    taken.value = { run, key: currentKey.value, same };
  };
  if (step === null) batch(change);
  else joinStep(change, step);
  spoken.value = `The settings of ${run.file ?? "the link"} are in use.`;
}

/** Applies its settings to the models that are open. */
export function useSettingsAnyway(): void {
  // Other models cannot give the same numbers.
  if (awaited.value) takeOver({ ...awaited.value, report: null }, null, false);
}

export function forgetRunFile(): void {
  batch(() => {
    awaited.value = null;
    taken.value = null;
  });
}

export async function saveRun(): Promise<void> {
  const shown = result.value;
  if (!shown) return;
  try {
    const { signal } = new AbortController();
    saveText("shapevenn-run.json", await engineClient().runFile(signal, shown.sources));
    dismiss("page");
  } catch (thrown) {
    report("page", thrown);
  }
}
