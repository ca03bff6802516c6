const EMBED = `<script type="module" src="shape-venn.js"></script>
<shape-venn scene="step" seed="7"></shape-venn>`;

/** How to use the lessons elsewhere: links, seeds, without a network, inside other pages, on a projector. */
export function Usage() {
  return (
    <section aria-labelledby="teacher-taking">
      <h3 id="teacher-taking">Links, seeds, no network, other pages</h3>
      <dl class="teacher-taking">
        <dt>A link is a state</dt>
        <dd>
          All settings are in the address: copy it into slides, and everybody sees the same picture
          with the same numbers. A link without settings opens a scene with its defaults, animated.
          Back undoes a change.
        </dd>
        <dt>The same draws for all, or different ones</dt>
        <dd>
          Random numbers follow from <code>seed=1</code> in the address. The same seed gives the
          same draws, to the last digit, on every computer. For different draws give each student
          another seed, such as <code>seed=</code> and the last digits of their number, and compare.
        </dd>
        <dt>Check it elsewhere</dt>
        <dd>
          <code>shapevenn lesson "page=learn&amp;scene=step&amp;seed=7&amp;steps=120" --json</code>{" "}
          prints the numbers that the page shows.
        </dd>
        <dt>Without a network</dt>
        <dd>
          Unpack <code>shapevenn.zip</code> (made by <code>npm run zip</code>), run{" "}
          <code>python3 serve.py</code> in it, and open the address that it prints. Nothing is
          fetched from anywhere else.
        </dd>
        <dt>Inside a course page</dt>
        <dd>
          <pre>
            <code>{EMBED}</code>
          </pre>
          with the address of <code>shape-venn.js</code>, which is in the same folder as this page.
          The attributes are the keys of a link.
        </dd>
        <dt>On a projector</dt>
        <dd>
          Press P for large letters, F for full screen. Space pauses the animation; it does not
          start by itself if the system asks for reduced motion.
        </dd>
      </dl>
    </section>
  );
}
