import { demo, spoken } from "../state";
import { About } from "./About";
import { Chooser } from "./Chooser";
import { Downloads } from "./Downloads";
import { DropOverlay } from "./DropOverlay";
import { Header } from "./Header";
import { ModelCard } from "./ModelCard";
import { Notices } from "./Notices";
import { PairCard } from "./PairCard";
import { Headline, Results } from "./Results";
import { RunPanel } from "./RunPanel";
import { SettingsPanel } from "./SettingsPanel";
import { Stage } from "./Stage";

export function App() {
  return (
    <>
      <Header />
      <main>
        <div class="centre">
          <Notices place="page" />
          <Notices place="link" />
          <Headline />
          <Stage />
        </div>
        <div class="rail models">
          <ModelCard side="a" />
          <ModelCard side="b" />
          <p class="privacy">
            {demo.value && `${demo.value.note} `}
            Drop files or folders anywhere. Your files stay on this computer.
          </p>
          <PairCard />
          <RunPanel />
          <SettingsPanel />
        </div>
        <div class="rail reading">
          <Results />
          <Downloads />
          <About />
        </div>
      </main>
      <DropOverlay />
      <Chooser />
      <p class="unseen" aria-live="polite">
        {spoken.value}
      </p>
    </>
  );
}
