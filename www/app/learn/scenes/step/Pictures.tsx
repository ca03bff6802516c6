import { LessonCanvas } from "../../canvas/LessonCanvas";
import { drawWalk, type Shown } from "./draw";
import { Mixture } from "./Mixture";
import { drawNear } from "./near";
import { EXTENT, type StepRun } from "./run";

/** Pictures of the chains in the plane of two coefficients, and of the last step magnified; drawn every frame. */
export function Pictures({ run, slow, chains }: { run: StepRun; slow: boolean; chains: number }) {
  const image = run.image.value;
  const decisions = run.decisions.value;
  const shown: Shown | null = image && {
    image,
    trail: run.trail,
    decisions,
    told: run.told.value,
    slow,
  };
  return (
    <>
      <figure>
        <LessonCanvas
          label={`Density of the intersection over two coefficients from −${EXTENT} to ${EXTENT} standard deviations, and ${chains === 1 ? "a chain that walks" : `${chains} chains that walk`} on it`}
          aspect={1}
          draw={(pen, size, palette) => shown && drawWalk(pen, size, palette, shown)}
        />
        <figcaption class="board-caption">
          Bright: high density of the intersection. Dashed circles: 1, 2 and 3 SD of the model’s own
          shapes.
        </figcaption>
      </figure>
      <figure class="step-near">
        <LessonCanvas
          label="The last step magnified: the state, the circles or the ray of the proposal, the proposal, and whether it was accepted"
          aspect={1}
          draw={(pen, size, palette) => shown && drawNear(pen, size, palette, shown)}
        />
        <figcaption class="board-caption">
          Magnified. Grey: proposal; <b class="good">✓</b> accepted; <b class="bad">✕</b> rejected.
          <Mixture part={decisions.at(-1)?.part} />
        </figcaption>
      </figure>
    </>
  );
}
