import type { LessonPoint, Side } from "../../../../worker/protocol";
import { percent } from "../../../text/format";
import { Segments } from "../../../ui/Segments";
import { LessonNumber, LessonNumbers, PlayBar } from "../../parts/controls";
import { StarPairs } from "../../parts/StarPairs";
import type { SceneValues } from "../../scenes";
import { resetScene, setParams } from "../../state";

interface Props {
  point: LessonPoint | null;
  playing: boolean;
  onToggle: () => void;
  pair: SceneValues<"model">["pair"];
  side: Side;
}

/** Panel of the scene: plausibility of the shape, and the choice of the model. */
export function ModelSide({ point, playing, onToggle, pair, side }: Props) {
  return (
    <div class="scene-side">
      <PlayBar playing={playing} onToggle={onToggle} onReset={resetScene} />
      <p class="board-caption" id="model-help">
        Drag the point, or move it with the arrow keys: by 0.1, with Shift by 0.5. Home goes to the
        mean.
      </p>
      <LessonNumbers label="The shape in numbers">
        <LessonNumber label="‖α‖, from the mean" metric="point.norm" value={point?.norm} />
        <LessonNumber
          label="log p(α) + const = −½‖α‖²"
          metric="point.logPrior"
          value={point?.logPrior}
        />
      </LessonNumbers>
      <p class="model-claim">
        More plausible than{" "}
        <strong class="num" data-metric="point.plausibility" data-value={point?.plausibility}>
          {point ? percent(point.plausibility) : "–"}
        </strong>{" "}
        of the shapes that this model makes.
      </p>
      <div class="model-choice">
        <StarPairs
          label="Stars"
          value={pair}
          onChoose={(chosen) => setParams("model", { pair: chosen })}
        />
        <Segments
          legend="Which model"
          name="model-side"
          value={side}
          options={[
            ["a", "Model A"],
            ["b", "Model B"],
          ]}
          onChoose={(chosen) => setParams("model", { side: chosen })}
        />
      </div>
    </div>
  );
}
