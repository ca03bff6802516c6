/** Opens the page: numbers first, then the engine, the models and their shapes. */
import { batch, effect } from "@preact/signals";
import { watchContent } from "./address/checked";
import { storedResult, watchChoices, watchPictures } from "./comparison";
import { FIRST_DEMO } from "./demos";
import { engineClient } from "./engine";
import { watchExplorer } from "./explore/asking";
import { watchPlaying } from "./explore/playing";
import { apply, keepLink, modelsOf, shelfOf } from "./history";
import { titleOf } from "./learn/scenes";
import { lessonState, scene } from "./learn/state";
import { type LinkState, misread, readLink, SETTING_KEYS } from "./link";
import { watchMaps } from "./maps";
import { demoModels, openPair } from "./models";
import { watchPair } from "./pair";
import { awaitLink, watchRunFile } from "./runfile/run";
import { settingsKey } from "./settings";
import { restoreShelf } from "./shelf/actions";
import { watchMatrix } from "./shelf/matrix";
import { watchEngine } from "./shelf/reopen";
import {
  begun,
  embedded,
  linked,
  notify,
  nouns,
  page,
  pageState,
  result,
  run,
  settings,
} from "./state";
import { fetchStored } from "./stored";
import { watchTheme } from "./theme";
import { joinUntil } from "./undo";

export function boot(): void {
  const link = readLink(location.hash);
  linked.value = link;
  apply(link);
  watchTheme();
  watchDocument();
  watchEngine();
  if (link.page === "compare") {
    void bootComparison(link).then(() => {
      keepLink(waits);
      return restoreShelf(shelfOf(link));
    });
    return;
  }
  keepLink(waits);
  // Other pages need none of it, until somebody turns to the comparison.
  const stop = effect(() => {
    if (page.value !== "compare") return;
    queueMicrotask(() => {
      stop();
      const link = readLink(location.hash);
      void joinUntil(bootComparison(link)).then(() => restoreShelf(shelfOf(link)));
    });
  });
}

/** Whether what a link compares must be brought first. */
const waits = (link: LinkState) => awaitLink(link) !== null;

async function bootComparison(link: LinkState): Promise<void> {
  begun.value = true;
  tellMisread();
  engineClient();
  const models = openModels(link);
  const stored = await fetchStored();
  if (stored && wants(link, settingsKey(stored.settings))) {
    // Whoever restores sees whether this failed; until then it is not unhandled.
    stored.draws().catch(() => undefined);
    batch(() => {
      settings.value = stored.settings;
      result.value = storedResult(stored);
    });
  }
  watchPair();
  watchChoices(stored);
  watchPictures();
  watchExplorer();
  watchPlaying();
  watchMaps();
  watchMatrix();
  watchRunFile();
  watchContent();
  await models;
}

/** Whether the address asks for the stored comparison, as an address that says nothing does. */
function wants(link: LinkState, storedKey: string): boolean {
  if (link.urls || link.demo !== FIRST_DEMO.id) return false;
  const asked = new URLSearchParams(location.hash.slice(1));
  const silent = !SETTING_KEYS.some((key) => asked.has(key));
  return silent || settingsKey(link.settings) === storedKey;
}

/** A link of a newer page may ask for what this one does not have. */
function tellMisread(): void {
  const found = misread(location.hash);
  if (found.length === 0) return;
  notify(
    "link",
    "link-setting",
    `The link asks for ${found.join(" and ")}, which this page does not know.`,
    "The default is used instead.",
  );
}

async function openModels(link: LinkState): Promise<void> {
  const waiting = awaitLink(link);
  if (waiting) return waiting;
  const { a, b } = modelsOf(link) ?? demoModels(FIRST_DEMO);
  await openPair(a, b);
}

/** What the document itself shows of the state. */
function watchDocument(): void {
  effect(() => {
    document.documentElement.dataset.state =
      page.value === "learn"
        ? lessonState.value
        : page.value === "gallery"
          ? "done"
          : pageState.value;
  });
  // For styles/embed.css.
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
