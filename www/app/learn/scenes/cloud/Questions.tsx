/** What to think about before the answer is looked at. */
export function Questions() {
  return (
    <div class="scene-questions">
      <details>
        <summary>Which sampler needs the fewest draws? Change it and compare the dots</summary>
        <p>
          The independence sampler: its draws are nearly independent, so d<sub>G</sub> follows the
          dashed line from the start. Draws of the walks hang together; as many of them are worth
          far fewer.
        </p>
      </details>
      <details>
        <summary>How can a closed form beat any number of draws?</summary>
        <p>
          For stars the posterior is a Gaussian, as only one point is away from the other model. Its
          mean and covariance follow from linear algebra, with no noise at all. What is left of d_G
          is what σ lets through.
        </p>
      </details>
      <details>
        <summary>Why is the model of the draws narrower than the truth?</summary>
        <p>
          A draw must be plausible in A <em>and</em> in B: the paper multiplies both plausibilities.
          Even the intersection of a model with itself would come out with half its variance. d
          <sub>G</sub> does not mind: it compares directions, not lengths.
        </p>
      </details>
    </div>
  );
}
