/** Writes the state of the page into its address and reads it back, so that Back is undo. */
import { batch, computed, effect, type Signal, untracked } from "@preact/signals";
import type { Side } from "../../worker/protocol";
import { applyLesson, settledLesson } from "../learn/state";
import { arrange, giveUpAdding, restoreModelList } from "../models/list/actions";
import { closeUnused } from "../models/list/handles";
import { measure } from "../models/list/matrix";
import { isUsed } from "../models/list/order";
import { demoModels, giveUpOpening, openPair } from "../models/opening";
import { demoSource, first, isOpen, sourceText, wantedOf } from "../models/sources";
import { findDemo } from "../state/demos";
import { applyExplorer, lockedHeat, settledExplorer } from "../state/exploring";
import type { LinkedModels } from "../state/linked-models";
import { HASH_DIGITS } from "../state/settings";
import {
  aboutLink,
  begun,
  camera,
  demo,
  diagnosedMode,
  diagnosedSide,
  embedded,
  exaggeration,
  linked,
  lockedRange,
  mapMode,
  modelList,
  namesInLinks,
  page,
  painting,
  pairRank,
  picture,
  region,
  SIDES,
  type Slot,
  type Source,
  settings,
  settledExaggeration,
  shapesSeed,
  slotKey,
  slots,
  spoken,
  tab,
  vertex,
  vertexMap,
  view,
  type Wanted,
} from "../state/state";
import { joins, type Snapshot, steps } from "../state/undo";
import { fitsLink, type LinkState, mayMeanAnotherSigma, readLink, writeLink } from "./link";
import { mayBeOlder } from "./older";
import { tellLink } from "./told";

const WRITE_AFTER_MS = 1000;

export const { undoable, redoable } = steps;

/** The part of the state that no link can hold. */
export const unlinkable = computed(() => ({
  files: SIDES.filter((side) => slots[side].value?.source.kind === "files"),
  modelList:
    isUsed(modelList.value) && modelList.value.some(({ source }) => source.kind !== "demo"),
  shapes: SIDES.some((side) => slots[side].value?.shapes),
  points: !fitsLink(settings.value.prepare.points),
}));

/** The models as a link names them; a model that is not open yet as the last link named it. */
function models(): LinkedModels {
  const asked = linked.value;
  const each = <T>(of: (slot: Slot) => T, otherwise: (side: Side) => T) => {
    const [a, b] = SIDES.map((side) => {
      const slot = slots[side].value;
      return slot ? of(slot) : otherwise(side);
    });
    return { a: a ?? null, b: b ?? null };
  };
  return {
    urls: demo.value
      ? null
      : each(
          ({ source }) => sourceText(source),
          (side) => asked?.urls?.[side] ?? null,
        ),
    names: each(
      ({ source }) => (source.kind === "files" && namesInLinks.value ? source.name : null),
      (side) => asked?.names[side] ?? null,
    ),
    hashes: each(
      ({ source, report }) =>
        source.kind === "demo" ? null : (report.fingerprint?.slice(0, HASH_DIGITS) ?? null),
      (side) => asked?.hashes[side] ?? null,
    ),
    // The part of each file, if it is not the first.
    parts: each(
      ({ part, parts }) => (part === parts[0] ? null : part),
      (side) => asked?.parts[side] ?? null,
    ),
    readings: each(
      ({ reading }) => reading || null,
      (side) => asked?.readings[side] ?? null,
    ),
  };
}

/** The models of the model list that come with the page, if the list is in use. */
function listed(): string[] {
  if (!isUsed(modelList.value)) return [];
  return modelList.value.flatMap(({ source }) => (source.kind === "demo" ? source.name : []));
}

/** The parts of a link that are more than the value of one signal. */
type Composed =
  | keyof LinkedModels
  | ("page" | "embed" | "demo" | "lesson" | "explorer" | "exaggeration" | "modelList");
type Simple = Exclude<keyof LinkState, Composed>;

/** The signal that holds each other part of a link. */
const SIGNALS: { [Part in Simple]: Signal<LinkState[Part]> } = {
  settings,
  tab,
  view,
  map: vertexMap,
  mapMode,
  vertex,
  scale: lockedRange,
  heatScale: lockedHeat,
  side: diagnosedSide,
  coefficient: diagnosedMode,
  region,
  picture,
  shapes: shapesSeed,
  rank: pairRank,
  measure,
  camera,
};
const SIMPLE_PARTS = Object.keys(SIGNALS) as Simple[];

function simpleParts(): Pick<LinkState, Simple> {
  const values = SIMPLE_PARTS.map((part) => [part, SIGNALS[part].value]);
  return Object.fromEntries(values) as Pick<LinkState, Simple>;
}

function setPart<Part extends Simple>(part: Part, link: LinkState): void {
  SIGNALS[part].value = link[part];
}

/** The link of the present state. */
function present(): LinkState {
  return {
    page: page.value,
    lesson: settledLesson.value,
    embed: embedded.value,
    demo: demo.value?.id ?? "files",
    ...models(),
    ...simpleParts(),
    explorer: settledExplorer.value,
    exaggeration: settledExaggeration.value,
    modelList: listed(),
  };
}

export function currentLink(embed = embedded.value): string {
  return writeLink({ ...present(), embed });
}

/** The link as a whole address, to share. */
export function sharedAddress(embed = false): string {
  const address = new URL(location.href);
  address.hash = currentLink(embed);
  return address.href;
}

/** Writes the present state into the address without a step of undo. */
export function writeAddress(): void {
  history.replaceState(history.state, "", `#${currentLink()}`);
}

/** The step of the history whose address somebody followed. */
let followed = 0;

/** Whether the address is that of a link of which something is said, or is still to be said, that was not seen yet. */
function isKept(): boolean {
  const told = aboutLink.value || mayBeOlder.value;
  return told && steps.at === followed;
}

/**
 * The part of the state whose change is a step of undo: the link without the camera and without settings of links,
 * and what no link can hold.
 */
const step = computed(() => {
  // On other pages changes of the comparison are no steps.
  if (page.value === "gallery") return page.value;
  if (page.value === "learn") return JSON.stringify([page.value, settledLesson.value]);
  const open = SIDES.map((side) => slots[side].value && slotKey(slots[side].value));
  const look = { ...present(), camera: null, embed: null, names: null };
  return JSON.stringify([open, modelList.value.map(slotKey), look]);
});

let applied = "";

/**
 * Starts the history; `takes` may take over a link that somebody typed or followed, `waits` says whether one waits for
 * files. While something is said of a link its address stays: whoever loads the page anew must be told it again.
 */
export function keepLink(takes: (link: LinkState) => boolean, waits: () => boolean): void {
  applied = untracked(() => step.value);
  steps.begin(snapshot());
  let timer: ReturnType<typeof setTimeout> | undefined;
  effect(() => {
    const fragment = `#${currentLink()}`;
    const meaningful = step.value !== applied;
    const kept = isKept() || (waits() && steps.at === followed);
    clearTimeout(timer);
    if (meaningful) {
      applied = step.value;
      // Saving a step must not trigger another one.
      // In a frame the Back button belongs to the page around it.
      const join = joins() || embedded.peek();
      const joined = kept ? location.href : fragment;
      untracked(() => (join ? steps.join(snapshot(), joined) : steps.push(snapshot(), fragment)));
      return;
    }
    if (kept) return;
    timer = setTimeout(writeAddress, WRITE_AFTER_MS);
  });
  addEventListener("popstate", (event) => void follow(event.state, takes));
  addEventListener("keydown", undoByKey);
}

export function undo(): void {
  steps.undo();
  if (undoable.peek()) spoken.value = "Undone.";
}

export function redo(): void {
  steps.redo();
  if (redoable.peek()) spoken.value = "Redone.";
}

/** The state of this step that no link can hold. */
function snapshot(): Snapshot {
  const wanted = (side: Side): Wanted | null => {
    const slot = slots[side].peek();
    return slot && wantedOf(slot);
  };
  const [a, b] = [wanted("a"), wanted("b")];
  return {
    models: a && b && { a, b },
    modelList: modelList.peek().map(wantedOf),
    points: settings.peek().prepare.points,
  };
}

/** Keys for undo and redo, except where text is typed. */
function undoByKey(event: KeyboardEvent): void {
  if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
  // While painting, strokes are undone instead.
  if (painting.peek() !== null) return;
  const { target } = event;
  if (target instanceof HTMLInputElement && !/range|radio|checkbox|file/.test(target.type)) return;
  const key = event.key.toLowerCase();
  const again = (key === "z" && event.shiftKey) || (key === "y" && !event.shiftKey);
  if (key !== "z" && !again) return;
  event.preventDefault();
  if (again) redo();
  else undo();
}

/** Number of steps that the browser went to; work for an earlier one is dropped. */
let journeys = 0;

/** Applies the address to the state, together with its models, so that no half-changed state is compared. */
async function follow(state: unknown, takes: (link: LinkState) => boolean): Promise<void> {
  journeys += 1;
  const mine = journeys;
  const snapshot = steps.arrive(state);
  const link = readLink(location.hash);
  if (snapshot === null) {
    followed = steps.at;
    linked.value = link;
    embedded.value = link.embed;
    tellLink(location.hash, link);
    mayBeOlder.value = mayMeanAnotherSigma(location.hash);
  }
  if (link.page !== "compare" || !begun.peek()) {
    batch(() => apply(link));
    return;
  }
  if (snapshot === null && takes(link)) return;
  const wanted = snapshot?.modelList ?? modelListOf(link);
  giveUpOpening();
  giveUpAdding();
  const complete = () => {
    if (mine !== journeys) return;
    apply(link);
    const { prepare } = settings.value;
    if (snapshot)
      settings.value = { ...settings.value, prepare: { ...prepare, points: snapshot.points } };
    arrange(wanted);
    applied = step.value;
  };
  const models = snapshot?.models ?? modelsOf(link);
  const changed = (side: Side) => {
    const slot = slots[side].value;
    const wanted = models?.[side];
    if (!wanted || (slot && isOpen(slot, wanted))) return null;
    return wanted;
  };
  const [a, b] = [changed("a"), changed("b")];
  const opened = (a || b) && (await openPair(a, b, () => batch(complete)));
  if (!opened) batch(complete);
  closeUnused();
  if (mine === journeys) await restoreModelList(wanted);
}

/** The models that an address names, except the visitor's own files. */
export function modelsOf(link: LinkState): Record<Side, Wanted | null> | null {
  const { urls: found, parts: named } = link;
  if (found) {
    const wanted = (side: Side): Wanted | null => {
      const address = found[side];
      return address === null
        ? null
        : { source: sourceOf(address), part: named[side], reading: link.readings[side] ?? "" };
    };
    return { a: wanted("a"), b: wanted("b") };
  }
  const known = findDemo(link.demo);
  return known ? demoModels(known) : null;
}

function sourceOf(address: string): Source {
  const demo = /^demo:(.+)/.exec(address)?.[1];
  return demo ? demoSource(demo) : { kind: "url", url: address };
}

/** The models that an address puts on the model list. */
export function modelListOf(link: LinkState): Wanted[] {
  return link.modelList.map((name) => first(demoSource(name)));
}

export function apply(link: LinkState): void {
  take(link);
  applied = step.value;
}

/** Opens a link as a step that can be undone. */
export function take(link: LinkState): void {
  batch(() => {
    embedded.value = link.embed;
    page.value = link.page;
    // The comparison stays unchanged while another page is shown.
    if (link.page === "learn") applyLesson(link.lesson);
    if (link.page !== "compare") return;
    for (const part of SIMPLE_PARTS) setPart(part, link);
    applyExplorer(link.explorer);
    exaggeration.value = link.exaggeration;
    settledExaggeration.value = link.exaggeration;
  });
}
