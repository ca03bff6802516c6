/** Keeps the address in step with the state, and the state with the address: Back is undo. */
import { batch, computed, effect, untracked } from "@preact/signals";
import { findDemo } from "./demos";
import { type LinkState, readLink, writeLink } from "./link";
import { openDemo, openPair } from "./models";
import {
  camera,
  demo,
  exaggeration,
  picture,
  region,
  settings,
  shapesSeed,
  slots,
  view,
} from "./state";

const WRITE_AFTER_MS = 1000;

/** Models from the user's own computer cannot be linked; their names are not put in a link. */
export const linkable = computed(() => demo.value !== null || urls() !== null);

function urls(): LinkState["urls"] {
  const [a, b] = [slots.a.value?.source, slots.b.value?.source];
  return a?.kind === "url" && b?.kind === "url" ? { a: a.url, b: b.url } : null;
}

export function currentLink(): string {
  return writeLink({
    demo: demo.value?.id ?? "files",
    urls: urls(),
    settings: settings.value,
    view: view.value,
    region: region.value,
    picture: picture.value,
    exaggeration: exaggeration.value,
    shapes: shapesSeed.value,
    camera: camera.value,
  });
}

/** Steps that Back undoes; the camera and the like only follow along. */
const step = computed(() =>
  JSON.stringify([demo.value?.id, urls(), settings.value, view.value, region.value, picture.value]),
);

let applied = "";

export function keepLink(): void {
  applied = untracked(() => step.value);
  let timer: ReturnType<typeof setTimeout> | undefined;
  effect(() => {
    const fragment = `#${currentLink()}`;
    const meaningful = step.value !== applied;
    clearTimeout(timer);
    if (meaningful) {
      applied = step.value;
      if (fragment !== location.hash) history.pushState(null, "", fragment);
      return;
    }
    timer = setTimeout(() => history.replaceState(null, "", fragment), WRITE_AFTER_MS);
  });
  addEventListener("popstate", () => void follow());
}

/** Takes over what the address says; models first, so that nothing half-changed is compared. */
async function follow(): Promise<void> {
  const link = readLink(location.hash);
  const wanted = link.urls;
  const now = urls();
  if (wanted && (wanted.a !== now?.a || wanted.b !== now?.b)) {
    await openPair({ kind: "url", url: wanted.a }, { kind: "url", url: wanted.b });
  } else if (!wanted && link.demo !== demo.value?.id) {
    const found = findDemo(link.demo);
    if (found) await openDemo(found);
  }
  apply(link);
}

export function apply(link: LinkState): void {
  batch(() => {
    settings.value = link.settings;
    view.value = link.view;
    region.value = link.region;
    picture.value = link.picture;
    exaggeration.value = link.exaggeration;
    shapesSeed.value = link.shapes;
    camera.value = link.camera;
  });
  applied = step.value;
}
