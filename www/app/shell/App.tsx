import { RunFileCard } from "../link/runfile/RunFileCard";
import { awaited } from "../link/runfile/run";
import { Chooser } from "../panels/Chooser";
import { Consent } from "../panels/Consent";
import { Downloads } from "../panels/Downloads";
import { ModelCard } from "../panels/ModelCard";
import { OfferedShapes } from "../panels/OfferedShapes";
import { PairCard } from "../panels/PairCard";
import { RunPanel } from "../panels/RunPanel";
import { SettingsPanel } from "../panels/SettingsPanel";
import { Specimens } from "../panels/Specimens";
import { PictureDialogs } from "../pictures/PictureDialogs";
import { ShareDialog } from "../share/ShareDialog";
import { demo, embedded, page, result, spoken, tab } from "../state/state";
import { wide } from "../state/wide";
import { Diagnostics } from "../tabs/diagnostics/Diagnostics";
import { Evidence } from "../tabs/evidence/Evidence";
import { Explorer } from "../tabs/explore/Explorer";
import { ExploreStage } from "../tabs/explore/ExploreStage";
import { Measures } from "../tabs/measures/Measures";
import { ModelTable } from "../tabs/models/ModelTable";
import { Headline, Results } from "../tabs/regions/Results";
import { Stage } from "../tabs/regions/Stage";
import { Later } from "../ui/Later";
import { Notices } from "../ui/Notices";
import { About } from "./About";
import { DropOverlay } from "./DropOverlay";
import { Embedded } from "./Embedded";
import { Header } from "./Header";
import { Tabs } from "./Tabs";

export function App() {
  return embedded.value ? (
    <>
      <Spoken />
      <PageShown framed />
    </>
  ) : (
    <WholePage />
  );
}

function WholePage() {
  return (
    <>
      <Header />
      <PageShown framed={false} />
      <DropOverlay />
      <Chooser />
      <Specimens />
      <OfferedShapes />
      <PictureDialogs />
      <ShareDialog />
      <Spoken />
    </>
  );
}

/** The shown page: comparison, lessons or gallery; in a frame a comparison shows only its shapes. */
function PageShown({ framed }: { framed: boolean }) {
  switch (page.value) {
    case "learn":
      return <Later key="learn" load={learn} />;
    case "gallery":
      return <Later key="gallery" load={gallery} />;
    case "compare":
      return framed ? <Embedded /> : <Comparison />;
  }
}

const learn = () => import("./Learn").then(({ Learn }) => Learn);
const gallery = () => import("../gallery/Gallery").then(({ Gallery }) => Gallery);

function Comparison() {
  // A link whose models are missing is shown in the centre as long as nothing was compared.
  const linkIsAll = Boolean(awaited.value?.link) && result.value === null;
  const explores = tab.value === "explore";
  return (
    <main class="comparison" data-tab={tab.value}>
      <div class="centre">
        <Notices place="page" />
        <Notices place="link" />
        <Notices place="older-link" />
        <Notices place="content" />
        <Consent />
        {linkIsAll && <RunFileCard />}
        <Headline />
        <Tabs />
        <Stage />
        {explores && <ExploreStage />}
        {explores && !wide.value && <Explorer />}
        {tab.value === "measures" && <Measures />}
        {tab.value === "evidence" && <Evidence />}
        {tab.value === "diagnostics" && <Diagnostics />}
        {tab.value === "models" && <ModelTable />}
      </div>
      <div class="rail models">
        <ModelCard side="a" />
        <ModelCard side="b" />
        {!linkIsAll && <RunFileCard />}
        <p class="privacy">
          {demo.value && `${demo.value.note} `}
          Drop files or folders anywhere. Your files stay on this computer.
        </p>
        <PairCard />
        <RunPanel />
        <SettingsPanel />
      </div>
      <div class="rail reading">
        {explores && wide.value && <Explorer />}
        {explores ? <FoldedResults /> : <Results />}
        <Downloads />
        <About />
      </div>
    </main>
  );
}

/** Messages for screen readers. */
function Spoken() {
  return (
    <p class="unseen" aria-live="polite">
      {spoken.value}
    </p>
  );
}

/** The results folded, so that the sliders of the explorer are in view. */
function FoldedResults() {
  return (
    <details class="more">
      <summary>Results of the comparison</summary>
      <Results />
    </details>
  );
}
