/** What to think about before the answer is looked at. */
export function Questions() {
  return (
    <div class="scene-questions">
      <details>
        <summary>Which of the four breaks does R-hat notice, and which not?</summary>
        <p>
          It notices chains that disagree: a σ far too small. It cannot notice that all chains agree
          on the wrong law (uncorrected scaling), that models were never aligned, or, with one
          chain, what that chain has not seen.
        </p>
      </details>
      <details>
        <summary>Why does the independence sampler win here, and when would it lose?</summary>
        <p>
          The intersection posterior is nearly Gaussian, and its fit costs a few iterations. Where a
          target is far from Gaussian, as the difference is, a fit says nothing of it and nearly all
          proposals would be rejected.
        </p>
      </details>
    </div>
  );
}
