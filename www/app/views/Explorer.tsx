/** Sliders and what they say, beside the stage. */
export function Explorer() {
  return <section class="explorer" aria-label="Explorer" />;
}
