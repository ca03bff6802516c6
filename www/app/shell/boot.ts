/** Starts the page: shows the stored numbers first, then loads the engine, the models and their shapes. */
import { batch, effect } from "@preact/signals";
import type { Side } from "../../worker/protocol";
import { storedResult, watchChoices, watchPictures } from "../comparison/run";
import { titleOf } from "../learn/scenes";
import { lessonState, scene } from "../learn/state";
import { apply, keepLink, modelListOf, modelsOf } from "../link/history";
import { type LinkState, mayMeanAnotherSigma, readLink } from "../link/link";
import { mayBeOlder, watchOlderLink } from "../link/older";
import { linkOfPage } from "../link/reading";
import { awaited, awaitLink, watchRunFile } from "../link/runfile/run";
import { tellLink } from "../link/told";
import { watchContent } from "../models/address/checked";
import { restoreModelList } from "../models/list/actions";
import { watchMatrix } from "../models/list/matrix";
import { watchEngine } from "../models/list/reopen";
import { demoModels, openPair } from "../models/opening";
import { watchPair } from "../models/pair";
import { watchMaps } from "../stage/maps";
import { watchPairs } from "../stage/pairs";
import { FIRST_DEMO } from "../state/demos";
import { engineClient, report } from "../state/engine";
import { settingsKey } from "../state/settings";
import {
  begun,
  embedded,
  linked,
  nouns,
  opening,
  page,
  pageState,
  result,
  run,
  SIDES,
  settings,
  shapes,
  slots,
  storedGeometry,
} from "../state/state";
import { fetchStored } from "../state/stored";
import { watchTheme } from "../state/theme";
import { joinUntil } from "../state/undo";
import { watchExplorer } from "../tabs/explore/asking";
import { watchPlaying } from "../tabs/explore/playing";
import { untilPictured } from "./pictured";

export function boot(): void {
  const link = readLink(linkOfPage(location));
  linked.value = link;
  apply(link);
  tellLink(linkOfPage(location), link);
  watchTheme();
  watchDocument();
  watchEngine();
  if (link.page === "compare") {
    bootComparison(link)
      .then(() => {
        keepLink(waits, isAwaited);
        return restoreModelList(modelListOf(link));
      })
      // As where no worker can be started: nothing is waited for without a word.
      .catch((thrown) => report("page", thrown));
    return;
  }
  keepLink(waits, isAwaited);
  // The other pages need none of it until the comparison is opened.
  const stop = effect(() => {
    if (page.value !== "compare") return;
    queueMicrotask(() => {
      stop();
      const link = readLink(linkOfPage(location));
      void joinUntil(bootComparison(link)).then(() => restoreModelList(modelListOf(link)));
    });
  });
}

/** Whether the visitor must open files before the link can be compared. */
const waits = (link: LinkState) => awaitLink(link) !== null;

/** Whether a link waits for such files. */
const isAwaited = () => Boolean(awaited.value?.link);

async function bootComparison(link: LinkState): Promise<void> {
  begun.value = true;
  mayBeOlder.value = mayMeanAnotherSigma(linkOfPage(location));
  const stored = await fetchStored(mayBeStored(link));
  if (stored && !anyTaken() && wants(link, settingsKey(stored.settings))) {
    batch(() => {
      settings.value = stored.settings;
      result.value = storedResult(stored);
      if (stored.picture) {
        storedGeometry.value = stored.picture.geometry;
        shapes.value = stored.picture.shapes;
      }
    });
    // What the picture needs has come: the engine, the models and the draws wait until it is seen.
    if (stored.picture && showsPicture(link)) await untilPictured();
    // A failure is handled when the comparison is restored.
    stored.draws().catch(() => undefined);
  }
  engineClient();
  const models = openModels(link);
  watchPair();
  watchChoices(stored);
  watchPictures();
  watchExplorer();
  watchPlaying();
  watchMaps();
  watchPairs();
  watchMatrix();
  watchRunFile();
  watchContent();
  watchOlderLink();
  await models;
}

/** Whether the address has the models of the stored comparison, as an empty one does. */
const mayBeStored = (link: LinkState) => !link.urls && link.demo === FIRST_DEMO.id;

/** Whether the address opens the stored comparison. */
function wants(link: LinkState, storedKey: string): boolean {
  return mayBeStored(link) && settingsKey(link.settings) === storedKey;
}

/** Whether the view of the address can be drawn from the stored picture alone. */
const showsPicture = ({ tab, view }: LinkState) =>
  tab === "regions" && (view === "contrast" || view === "mean");

async function openModels(link: LinkState): Promise<void> {
  const waiting = awaitLink(link);
  if (waiting) return waiting;
  const { a, b } = modelsOf(link) ?? demoModels(FIRST_DEMO);
  // What somebody has opened meanwhile stays.
  await openPair(isTaken("a") ? null : a, isTaken("b") ? null : b);
}

const isTaken = (side: Side) => slots[side].peek() !== null || opening[side].peek() !== null;
const anyTaken = () => SIDES.some(isTaken);

/** Writes the state to attributes and title of the document. */
function watchDocument(): void {
  effect(() => {
    document.documentElement.dataset.state =
      page.value === "learn"
        ? lessonState.value
        : page.value === "gallery"
          ? "done"
          : pageState.value;
  });
  // For embed.css.
  effect(() => {
    document.documentElement.toggleAttribute("data-embed", embedded.value);
  });
  effect(() => {
    document.documentElement.dataset.page = page.value;
  });
  effect(() => {
    if (page.value !== "compare") {
      document.title =
        page.value === "learn"
          ? `${titleOf(scene.value).title} – Shapevenn`
          : "Gallery – Shapevenn";
      return;
    }
    const fraction = run.value?.progress?.fraction;
    const name = `${nouns.value.a} and ${nouns.value.b}`;
    document.title = run.value
      ? `${Math.round(100 * (fraction ?? 0))}\u202f% – Shapevenn`
      : `Shapevenn: ${name}`;
  });
  addEventListener("beforeunload", (event) => {
    if (run.value) event.preventDefault();
  });
}
