/** Comparisons of what comes with the page, each with what there is to see. */
export function Gallery() {
  return <main class="gallery" />;
}
