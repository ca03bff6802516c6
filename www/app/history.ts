/** Keeps the address in step with the state, and the state with the address: Back is undo. */
import { batch, computed, effect, untracked } from "@preact/signals";
import type { PointSelection } from "../worker/protocol";
import { findDemo } from "./demos";
import { fitsLink, type LinkState, readLink, writeLink } from "./link";
import { demoModels, openPair } from "./models";
import {
  camera,
  demo,
  exaggeration,
  lockedRange,
  mapMode,
  painting,
  picture,
  region,
  room,
  SIDES,
  type Side,
  settings,
  shapesSeed,
  slotKey,
  slots,
  vertex,
  vertexMap,
  view,
  type Wanted,
} from "./state";

const WRITE_AFTER_MS = 1000;

/** What a step of the history holds that no address can: files, and long lists of points. */
interface Place {
  models: Record<Side, Wanted> | null;
  points: PointSelection | null;
}

const places: Place[] = [];

/** Models from the user's own computer cannot be linked; their names are not put in a link. */
export const linkable = computed(
  () => (demo.value !== null || urls() !== null) && fitsLink(settings.value.prepare.points),
);

function urls(): LinkState["urls"] {
  const [a, b] = [slots.a.value?.source, slots.b.value?.source];
  return a?.kind === "url" && b?.kind === "url" ? { a: a.url, b: b.url } : null;
}

/** The part of each file, where it is not the first. */
function parts(): LinkState["parts"] {
  const [a, b] = SIDES.map((side) => {
    const slot = slots[side].value;
    return slot && slot.part !== slot.parts[0] ? slot.part : null;
  });
  return { a: a ?? null, b: b ?? null };
}

export function currentLink(): string {
  return writeLink({
    demo: demo.value?.id ?? "files",
    urls: urls(),
    parts: parts(),
    settings: settings.value,
    room: room.value,
    view: view.value,
    map: vertexMap.value,
    mapMode: mapMode.value,
    vertex: vertex.value,
    scale: lockedRange.value,
    region: region.value,
    picture: picture.value,
    exaggeration: exaggeration.value,
    shapes: shapesSeed.value,
    camera: camera.value,
  });
}

/** Puts the present state into the address, without a step of its own. */
export function writeAddress(): void {
  history.replaceState(history.state, "", `#${currentLink()}`);
}

/** Steps that Back undoes; the camera and the like only follow along. */
const step = computed(() => {
  const models = SIDES.map((side) => slots[side].value && slotKey(slots[side].value));
  return JSON.stringify([
    models,
    settings.value,
    room.value,
    view.value,
    vertexMap.value,
    mapMode.value,
    vertex.value,
    lockedRange.value,
    region.value,
    picture.value,
  ]);
});

let applied = "";

export function keepLink(): void {
  applied = untracked(() => step.value);
  history.replaceState(placed(), "");
  let timer: ReturnType<typeof setTimeout> | undefined;
  effect(() => {
    const fragment = `#${currentLink()}`;
    const meaningful = step.value !== applied;
    clearTimeout(timer);
    if (meaningful) {
      applied = step.value;
      history.pushState(placed(), "", fragment);
      return;
    }
    timer = setTimeout(writeAddress, WRITE_AFTER_MS);
  });
  addEventListener("popstate", (event) => void follow(event.state));
  addEventListener("keydown", undoByKey);
}

/** Remembers where the page is; `undo` counts the steps that Back can take within it. */
function placed(): { place: number; undo: number } {
  const wanted = (side: Side): Wanted | null => {
    const slot = slots[side].peek();
    return slot && { source: slot.source, part: slot.part, scale: slot.scale };
  };
  const [a, b] = [wanted("a"), wanted("b")];
  places.push({ models: a && b && { a, b }, points: settings.peek().prepare.points });
  const former = history.state as { undo?: number } | null;
  return { place: places.length - 1, undo: places.length === 1 ? 0 : (former?.undo ?? 0) + 1 };
}

/** Undo and redo as everywhere, but never out of the page, nor where text is typed. */
function undoByKey(event: KeyboardEvent): void {
  if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
  // While something is painted, strokes are undone.
  if (painting.peek() !== null) return;
  const { target } = event;
  if (target instanceof HTMLInputElement && !/range|radio|checkbox|file/.test(target.type)) return;
  const key = event.key.toLowerCase();
  const redo = (key === "z" && event.shiftKey) || (key === "y" && !event.shiftKey);
  if (key !== "z" && !redo) return;
  event.preventDefault();
  if (redo) history.forward();
  else if ((history.state as { undo?: number } | null)?.undo) history.back();
}

/** Takes over what the address says; with the models, so that nothing half-changed is compared. */
async function follow(state: unknown): Promise<void> {
  const link = readLink(location.hash);
  const place = places[(state as { place?: number } | null)?.place ?? -1];
  const complete = () => {
    apply(link);
    const { prepare } = settings.value;
    if (place)
      settings.value = { ...settings.value, prepare: { ...prepare, points: place.points } };
    applied = step.value;
  };
  const models = place?.models ?? modelsOf(link);
  const changed = (side: Side) => {
    const slot = slots[side].value;
    const wanted = models?.[side];
    if (!wanted || (slot && isOpen(slot, wanted))) return null;
    return wanted;
  };
  const [a, b] = [changed("a"), changed("b")];
  if (a || b) await openPair(a, b, () => batch(complete));
  else batch(complete);
}

function isOpen(slot: NonNullable<typeof slots.a.value>, wanted: Wanted): boolean {
  return (
    slotKey(slot) === slotKey({ ...slot, ...wanted, part: wanted.part ?? slot.parts[0] ?? "" })
  );
}

/** What an address says of models; those of nobody's own files. */
export function modelsOf(link: LinkState): Record<Side, Wanted> | null {
  const { urls: found, parts: named } = link;
  if (found) {
    const wanted = (side: Side): Wanted => ({
      source: { kind: "url", url: found[side] },
      part: named[side],
      scale: false,
    });
    return { a: wanted("a"), b: wanted("b") };
  }
  const known = findDemo(link.demo);
  return known ? demoModels(known) : null;
}

export function apply(link: LinkState): void {
  batch(() => {
    settings.value = link.settings;
    room.value = link.room;
    view.value = link.view;
    vertexMap.value = link.map;
    mapMode.value = link.mapMode;
    vertex.value = link.vertex;
    lockedRange.value = link.scale;
    region.value = link.region;
    picture.value = link.picture;
    exaggeration.value = link.exaggeration;
    shapesSeed.value = link.shapes;
    camera.value = link.camera;
  });
  applied = step.value;
}
