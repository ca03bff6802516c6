export function About() {
  return (
    <footer class="about">
      <details>
        <summary>What is this?</summary>
        <p>
          A statistical shape model is a mean shape and the directions in which shapes vary. Given
          two such models on the same points, Shapevenn draws the shapes that both can make (A∩B),
          and those that only one of them can (A∖B, B∖A), and says how large each part is.
        </p>
        <p>
          The method is that of M. Weiherer, F. Klein and B. Egger,{" "}
          <cite>
            Approximating Intersections and Differences Between Linear Statistical Shape Models
            Using Markov Chain Monte Carlo
          </cite>
          , WACV 2024, with a faster sampler by default; the published one can be chosen. A model
          can make a shape of the other one if its nearest shape lies within about σ of it, on
          average per point.
        </p>
        <p>
          How the overlap of two models relates to the Bhattacharyya distance is studied for the
          bundled pairs in docs/overlap-study.md of the source.
        </p>
        <p>Everything is computed in this page. Your files stay on this computer.</p>
      </details>
    </footer>
  );
}
