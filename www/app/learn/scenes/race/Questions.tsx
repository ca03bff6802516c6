/** Questions about the scene, with answers to unfold. */
export function Questions() {
  return (
    <div class="scene-questions">
      <details>
        <summary>Which of the four failures does R-hat detect, and which not?</summary>
        <p>
          It detects chains that disagree: a σ far too small. It cannot detect that all chains agree
          on the wrong distribution (uncorrected scaling), that the models are not aligned, or, with
          one chain, which shapes that chain has not reached.
        </p>
      </details>
      <details>
        <summary>Why is the independence sampler best here, and when would it not be?</summary>
        <p>
          The posterior of the intersection is nearly Gaussian, and its fit takes a few iterations.
          If a target is far from Gaussian, as the difference is, a Gaussian fit describes it badly
          and most proposals would be rejected.
        </p>
      </details>
    </div>
  );
}
