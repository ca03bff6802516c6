import { sharedAddress } from "../link/history";
import { RunFileCard } from "../link/runfile/RunFileCard";
import { awaited } from "../link/runfile/run";
import { Consent } from "../panels/Consent";
import { MAP_WORDS } from "../stage/map-words";
import { regionLabel } from "../stage/names";
import { alone, inspection, nouns, run, tab, vertexMap, view } from "../state/state";
import { Diagnostics } from "../tabs/diagnostics/Diagnostics";
import { Evidence } from "../tabs/evidence/Evidence";
import { ExploreStage } from "../tabs/explore/ExploreStage";
import { Measures } from "../tabs/measures/Measures";
import { ModelTable } from "../tabs/models/ModelTable";
import { Headline } from "../tabs/regions/Results";
import { Stage } from "../tabs/regions/Stage";
import { percent } from "../text/format";
import { Notices } from "../ui/Notices";

/** The page as a frame in another page: one tab, a caption, and a link to the whole page. */
export function Embedded() {
  return (
    <main class="embedded" data-tab={tab.value}>
      <div class="centre">
        {(["page", "link", "content", "a", "b", "pair", "run"] as const).map((place) => (
          <Notices key={place} place={place} />
        ))}
        <Problem />
        <Consent />
        {awaited.value && <RunFileCard />}
        <Stage />
        {tab.value === "explore" && <ExploreStage />}
        {tab.value === "measures" && <Measures />}
        {tab.value === "evidence" && <Evidence />}
        {tab.value === "diagnostics" && <Diagnostics />}
        {tab.value === "models" && <ModelTable />}
      </div>
      <footer class="caption">
        <p class="caption-what">{shown()}</p>
        <Headline />
        <a href={sharedAddress()} target="_blank" rel="noopener">
          Open in Shapevenn
        </a>
      </footer>
    </main>
  );
}

/** Why the two models cannot be compared; the remedies are in the whole page. */
function Problem() {
  const problem = inspection.value?.problem;
  return problem ? (
    <div class="notice" role="alert" data-code={problem.code}>
      <div>
        <p class="notice-message">{problem.message}</p>
        <p class="notice-hint">{problem.hint}</p>
      </div>
    </div>
  ) : null;
}

/** Caption: names of the models and what is shown of them. */
function shown(): string {
  const { a, b } = nouns.value;
  const whose = `A: ${a}. B: ${b}.`;
  if (run.value) return `${whose} Comparing, ${percent(run.value.progress?.fraction ?? 0)} …`;
  if (tab.value !== "regions") return whose;
  const what = {
    contrast: "What each misses of the other",
    pairs: "Shapes beside the nearest of the other model",
    mean: "Mean shapes",
    samples: "Random shapes",
    sd: MAP_WORDS[vertexMap.value].label,
  }[view.value];
  return alone.value === null
    ? `${whose} ${what}.`
    : `${whose} ${what} of ${regionLabel(alone.value)}.`;
}
