import type { LessonModels } from "../../../../worker/lessons";
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

/** Whether the guess was right, by how much each tip strays, and what σ has to do with it. */
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
            label="σ, how near is near"
            value={sigma}
            least={0.001}
            most={1}
            step={0}
            logarithmic
            show={(value) => number(value, 2)}
            onChange={(value) => setParams("agree", { sigma: Number(value.toPrecision(2)) })}
          />
          <p>
            The two means, dashed, differ as well; hardly any star is made by both to the last
            digit. So <em>both can make it</em> asks two things of a star: that it is <b>near</b>{" "}
            some star of the other model (the mean distance of its points within about σ), and that
            it is <b>plausible</b> in both. Move σ: what happens when almost everything is near?
          </p>
        </div>
      </div>
      <details class="ask">
        <summary>
          A∩B moves the top tip less than A does, and less than B. Why, if both can do it?
        </summary>
        <p>
          Because what is plausible in both is rarer than what is plausible in one. The method
          multiplies the two plausibilities, exp(−½‖α‖²) and exp(−½‖α′‖²), and the product of two
          bells is a narrower bell, between the two. Even a model intersected with itself keeps only
          half of its variance.
        </p>
      </details>
    </>
  );
}
