/** Questions about the scene, with answers to unfold. */
export function Questions() {
  return (
    <div class="scene-questions">
      <details>
        <summary>Make σ smaller and smaller. What happens to the difference?</summary>
        <p>
          The hole gets narrower: fewer and fewer shapes lie within σ of the other model, until the
          difference is nearly the whole model. σ says how far apart two shapes may be and still
          count as the same.
        </p>
      </details>
      <details>
        <summary>Why is there no PCA of a difference?</summary>
        <p>
          The density of a Gaussian is highest at its mean, and the mean of these draws is in the
          hole: a shape that both models can make. So the paper gives draws of the difference, and
          no model.
        </p>
      </details>
      <details>
        <summary>Why are these draws independent, unlike those of a chain?</summary>
        <p>
          1 − Lᴅ lies between zero and one. Rejection sampling draws a shape of the model and
          accepts it with that probability: the accepted shapes are exact draws of the difference.
          The share of accepted shapes is the percentage above.
        </p>
      </details>
    </div>
  );
}
