/** Questions about the scene, with answers to unfold. */
export function Questions() {
  return (
    <div class="scene-questions">
      <details>
        <summary>Why is a less probable proposal ever accepted?</summary>
        <p>
          Otherwise the chain would go to the maximum of the density and stay there: it would find
          the most probable shape, but not how much shapes vary. A proposal with half the density is
          accepted half of the time, so the time spent at each shape is proportional to its density.
        </p>
      </details>
      <details>
        <summary>What does the Hastings factor correct?</summary>
        <p>
          The scaling move draws a new norm ‖α′‖ for the same direction. It is symmetric in the
          norm, but not as a density over α: spheres of smaller norm have less area. The factor
          (‖α′‖/‖α‖)<sup>q−1</sup> corrects for this. The paper leaves it out, so the norms of its
          walk are too small. Choose “as published” and see the line “Hastings factor”, or the
          failure “Uncorrected scaling” in the scene “The race”.
        </p>
      </details>
      <details>
        <summary>Why so many steps for so few effective draws?</summary>
        <p>
          Each state is near the one before it, so it adds little information. The effective sample
          size is the number of independent draws that would estimate the mean equally well.
        </p>
      </details>
    </div>
  );
}
