/** Questions about the scene, with answers to unfold. */
export function Questions() {
  return (
    <div class="scene-questions">
      <details>
        <summary>Which sampler needs the fewest draws? Change it and compare the dots</summary>
        <p>
          The independence sampler: its draws are nearly independent, so d<sub>G</sub> follows the
          dashed line from the start. Draws of the random walks are correlated; the same number of
          draws has a much smaller effective sample size.
        </p>
      </details>
      <details>
        <summary>Why can a closed form be more accurate than any number of draws?</summary>
        <p>
          For stars the posterior is a Gaussian, since only one point is away from the other model.
          Its mean and covariance follow from linear algebra, without sampling noise. The remaining
          d<sub>G</sub> comes from σ.
        </p>
      </details>
      <details>
        <summary>Why has the model of the draws less variance than the true intersection?</summary>
        <p>
          A draw must be plausible in A <em>and</em> in B: the paper multiplies both plausibilities.
          Even the intersection of a model with itself would have half its variance. d<sub>G</sub>{" "}
          does not depend on this: it compares directions, not variances.
        </p>
      </details>
    </div>
  );
}
