import { contrastSentence } from "../../stage/contrast";

/** What was done to the shapes of the differences in the view Contrast. */
export function ContrastCaption() {
  const sentence = contrastSentence.value;
  return sentence && <p class="small contrast-caption">{sentence}</p>;
}
