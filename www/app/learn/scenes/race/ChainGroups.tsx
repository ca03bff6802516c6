import { LessonCanvas } from "../../canvas/LessonCanvas";
import { SAMPLER_NAMES } from "../../sampling/names";
import { params } from "../../state";
import { drawRunner, type Scenery } from "./draw";
import type { RaceRun, Runner } from "./run";

/** Pictures of the chains, one for each sampler. */
export function ChainGroups({ run }: { run: RaceRun }) {
  // Renders again after every step.
  run.step.value;
  const [image, view, models] = [run.image.value, run.view.value, run.models.value];
  const { side, break: what } = params("race").value;
  const fit = models && what !== "scaling" ? models.fits[side] : null;
  const scenery = image && view && { image, view, fit };
  return (
    <div class="race-groups" data-count={run.runners.value.length}>
      {run.runners.value.map((runner) => (
        <ChainGroup key={runner.sampler} runner={runner} scenery={scenery} />
      ))}
    </div>
  );
}

interface GroupProps {
  runner: Runner;
  scenery: Scenery | null;
}

function ChainGroup({ runner, scenery }: GroupProps) {
  return (
    <figure>
      <LessonCanvas
        label={`${SAMPLER_NAMES[runner.sampler]}: its chains over the first two coefficients`}
        aspect={1}
        draw={(pen, size, palette) => {
          if (scenery) drawRunner(pen, size, palette, runner, scenery);
        }}
      />
      <figcaption>{SAMPLER_NAMES[runner.sampler]}</figcaption>
    </figure>
  );
}
