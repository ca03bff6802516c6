import { awaited } from "../runfile/run";
import { demo, embedded, page, result, room, spoken } from "../state";
import { wide } from "../wide";
import { About } from "./About";
import { Chooser } from "./Chooser";
import { Consent } from "./Consent";
import { Diagnostics } from "./Diagnostics";
import { Downloads } from "./Downloads";
import { DropOverlay } from "./DropOverlay";
import { Embedded } from "./Embedded";
import { Explorer } from "./Explorer";
import { ExploreStage } from "./explore/ExploreStage";
import { Header } from "./Header";
import { Later } from "./Later";
import { Measures } from "./Measures";
import { ModelCard } from "./ModelCard";
import { ModelTable } from "./ModelTable";
import { Notices } from "./Notices";
import { PairCard } from "./PairCard";
import { Headline, Results } from "./Results";
import { Rooms } from "./Rooms";
import { RunFileCard } from "./RunFileCard";
import { RunPanel } from "./RunPanel";
import { SettingsPanel } from "./SettingsPanel";
import { ShareDialog } from "./ShareDialog";
import { Stage } from "./Stage";
import { Taking } from "./Taking";

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
      <Taking />
      <ShareDialog />
      <Spoken />
    </>
  );
}

/** What the page is for just now; of a comparison, in a frame only the shapes. */
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

const learn = () => import("../learn/Learn").then(({ Learn }) => Learn);
const gallery = () => import("./Gallery").then(({ Gallery }) => Gallery);

function Comparison() {
  // Before anything is compared, what a link waits for is all that there is.
  const linkIsAll = Boolean(awaited.value?.link) && result.value === null;
  const explores = room.value === "explore";
  return (
    <main class="comparison" data-room={room.value}>
      <div class="centre">
        <Notices place="page" />
        <Notices place="link" />
        <Notices place="content" />
        <Consent />
        {linkIsAll && <RunFileCard />}
        <Headline />
        <Rooms />
        <Stage />
        {explores && <ExploreStage />}
        {explores && !wide.value && <Explorer />}
        {room.value === "measures" && <Measures />}
        {room.value === "diagnostics" && <Diagnostics />}
        {room.value === "models" && <ModelTable />}
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

/** For screen readers. */
function Spoken() {
  return (
    <p class="unseen" aria-live="polite">
      {spoken.value}
    </p>
  );
}

/** Out of the way of the sliders. */
function FoldedResults() {
  return (
    <details class="more">
      <summary>Results of the comparison</summary>
      <Results />
    </details>
  );
}
