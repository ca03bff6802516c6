import { chanceTopic } from "../../comparison/answer";
import { contrastSentence } from "../../stage/contrast";
import { result } from "../../state/state";

/** What was done to the shapes of the differences in the view Contrast, and whether they are worth a look. */
export function ContrastCaption() {
  const sentence = contrastSentence.value;
  const report = result.value?.report;
  const chance = report && chanceTopic(report) === "no-more-than-chance";
  return (
    sentence && (
      <p class="small contrast-caption">
        {sentence}
        {chance && " Differences like these are what chance gives."}
      </p>
    )
  );
}
