/** What to think about before the answer is looked at. */
export function Questions() {
  return (
    <div class="scene-questions">
      <details>
        <summary>Make σ smaller and smaller. What becomes of the difference?</summary>
        <p>
          The ridge gets thinner: fewer and fewer shapes lie within σ of the other model, until the
          hole is a scratch and the difference is all of the model. σ says how far apart two shapes
          may be and still count as the same.
        </p>
      </details>
      <details>
        <summary>Why no principal components of a difference?</summary>
        <p>
          A Gaussian is highest in the middle, and the middle is the hole. Its mean shape is one
          that both models make. So the paper gives draws of the difference, and no model.
        </p>
      </details>
      <details>
        <summary>Why are these draws independent, unlike those of a chain?</summary>
        <p>
          1 − Lᴅ lies between nought and one. Draw a shape of the model and keep it with that
          probability: what is kept follows the difference exactly. The share that is kept is the
          headline above.
        </p>
      </details>
    </div>
  );
}
