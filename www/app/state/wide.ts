/** Whether the window is wide enough for three columns, as in shell/page.css. */
import { signal } from "@preact/signals";

const query = matchMedia("(min-width: 1100px)");
export const wide = signal(query.matches);

query.addEventListener("change", () => {
  wide.value = query.matches;
});
