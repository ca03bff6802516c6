import { useMemo } from "preact/hooks";
import { LessonCanvas } from "../../canvas/LessonCanvas";
import { drawCut } from "./cut";
import { drawDifference, Morph } from "./draw";
import type { DifferenceRun } from "./run";

/** The plane of two coefficients, a component of its own since it is drawn every frame. */
export function Plane({ run, side }: { run: DifferenceRun; side: "a" | "b" }) {
  const morph = useMemo(() => new Morph(), []);
  const found = run.found.value;
  const flip = run.flip.value;
  run.rain.value;
  const what = flip > 0.5 ? "difference" : "intersection";
  return (
    <figure>
      <LessonCanvas
        label={`Density of the ${what} over two coefficients, with its draws and the ellipse of two standard deviations of their PCA`}
        aspect={1}
        draw={(pen, size, palette) => {
          if (!found) return;
          const fallen = (draws: number) => run.fallen(draws);
          drawDifference(pen, size, palette, { found, morph, flip, side, fallen });
        }}
      />
      <figcaption class="board-caption">
        Bright: high density of the {what}. Dots: exact draws by rejection sampling. Dashed: the
        ellipse of their mean and covariance.
      </figcaption>
    </figure>
  );
}

export function Cut({ run }: { run: DifferenceRun }) {
  const found = run.found.value;
  const flip = run.flip.value;
  return (
    <figure>
      <LessonCanvas
        label={`${flip > 0.5 ? "1 − Lᴅ" : "Lᴅ"} along the second coefficient where the first is 0`}
        aspect={0.36}
        draw={(pen, size, palette) => found && drawCut(pen, size, palette, found.likelihood, flip)}
      />
      <figcaption class="board-caption">
        A cut along α₂ at α₁ = 0: {flip > 0.5 ? "1 − Lᴅ" : "Lᴅ"}.
      </figcaption>
    </figure>
  );
}
