/** What to think about before the answer is looked at. */
export function Questions() {
  return (
    <div class="scene-questions">
      <details>
        <summary>Why is a worse proposal ever accepted?</summary>
        <p>
          If it never were, the walk would climb to the top and stay there: it would find the most
          plausible shape, not how much shapes may vary. Accepting a proposal that is half as
          plausible half of the time makes the time spent at each shape proportional to its density.
        </p>
      </details>
      <details>
        <summary>What does the Hastings factor put right?</summary>
        <p>
          The scaling move draws a new length ‖α′‖ for the same direction. A step from long to short
          lands on a smaller sphere, so it is met more often than its way back. The factor
          (‖α′‖/‖α‖)<sup>q−1</sup> makes up for it. The paper leaves it out: its walk shrinks.
          Choose “as published” and watch the last line but one, or break it in the race.
        </p>
      </details>
      <details>
        <summary>Why so many steps for so few effective draws?</summary>
        <p>
          Each state is near the one before it, so that a new one says little new. The effective
          sample size is how many independent draws would know the mean as well.
        </p>
      </details>
    </div>
  );
}
