import { LessonCanvas } from "../../canvas/LessonCanvas";
import { still } from "../../clock";
import { BOUNDS } from "../../sampling/polar";
import { drawModel, drawStars } from "./draw";
import { drawPolar } from "./polar";
import type { CloudRun } from "./run";

/** Pictures of the draws, of their model with the true intersection, and of the angles of the tips. */
export function Pictures({ run, pair }: { run: CloudRun; pair: string }) {
  const [models, stars] = [run.models.value, run.stars.value];
  const segments = models?.segments ?? [];
  const length = models ? models.dimension * models.points : 1;
  const bound = BOUNDS[pair] ?? null;
  return (
    <div class="boards cloud-boards">
      <figure>
        <LessonCanvas
          label="Stars drawn from both models, overlaid; their first tips as dots"
          aspect={1}
          draw={(pen, size, palette) =>
            stars && drawStars(pen, size, palette, stars, segments, length)
          }
        />
        <figcaption class="board-caption">
          The draws: <b class="side-a">of A, near B</b> and <b class="side-b">of B, near A</b>.
        </figcaption>
      </figure>
      <Swaying run={run} />
      <figure>
        <LessonCanvas
          label={`Polar histogram of the angles of the five tips; both models can make the first within ${bound ?? "–"} degrees`}
          aspect={1}
          draw={(pen, size, palette) =>
            stars && drawPolar(pen, size, palette, stars, length, bound)
          }
        />
        <figcaption class="board-caption">
          Histogram of the rotation of each tip, as in the paper. Both models have tip 1 within −
          {bound}…{bound}°.
        </figcaption>
      </figure>
    </div>
  );
}

/** The oscillating model, a component of its own since it is drawn every frame. */
function Swaying({ run }: { run: CloudRun }) {
  const [models, found] = [run.models.value, run.found.value];
  const sway = still.value ? 1 : run.sway.value;
  return (
    <figure>
      <LessonCanvas
        label="The model of the draws, solid, and the true intersection, dashed, oscillating by two standard deviations along their first mode"
        aspect={1}
        draw={(pen, size, palette) => {
          if (!models || !found) return;
          drawModel(pen, size, palette, found.model, models.truth, models.segments ?? [], sway);
        }}
      />
      <figcaption class="board-caption">
        <b class="side-ab">PCA of the draws</b> and the true intersection (dashed): mean ± 2 SD of
        mode 1.
      </figcaption>
    </figure>
  );
}
