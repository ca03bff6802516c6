import type { LessonModels } from "../../../../worker/protocol";
import { number } from "../../../text/format";
import { Slider } from "../../parts/controls";
import { setParams } from "../../state";
import { TipTable } from "./TipTable";
import { answerIn, movable, sharedTips, verdictOn } from "./tips";

interface Props {
  models: LessonModels;
  guess: readonly number[];
  sigma: number;
}

/** Shows whether the guess was right, the standard deviation of each tip, and the effect of σ. */
export function Answer({ models, guess, sigma }: Props) {
  const tips = {
    a: movable(models.a.vertexSd),
    b: movable(models.b.vertexSd),
    both: movable(models.intersection.vertexSd),
  };
  const shared = sharedTips(tips);
  return (
    <>
      <div class="agree-answer">
        <p class="agree-verdict" role="status" data-verdict={verdictOn(guess, shared)}>
          {answerIn(guess, tips)}
        </p>
        <TipTable models={models} shared={shared} guess={guess} />
        <div class="agree-sigma">
          <Slider
            label="σ, tolerance of “near”"
            value={sigma}
            least={0.001}
            most={1}
            step={0}
            logarithmic
            show={(value) => number(value, 2)}
            onChange={(value) => setParams("agree", { sigma: Number(value.toPrecision(2)) })}
          />
          <p>
            The two means, dashed, differ as well, so hardly any star is exactly in both models.
            That <em>both can make</em> a star therefore means two things: it is <b>near</b> some
            star of the other model (the mean distance of its points is at most about σ), and it is{" "}
            <b>plausible</b> in both. Move σ: what happens when almost everything is near?
          </p>
        </div>
      </div>
      <details class="ask">
        <summary>
          A∩B moves the top tip less than A does, and less than B. Why, if both can move it?
        </summary>
        <p>
          Because fewer shapes are plausible in both models than in one. The method multiplies the
          two plausibilities, exp(−½‖α‖²) and exp(−½‖α′‖²), and the product of two Gaussians is a
          narrower Gaussian between them. Even the intersection of a model with itself has only half
          of its variance.
        </p>
      </details>
    </>
  );
}
