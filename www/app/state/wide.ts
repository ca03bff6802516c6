/** Whether the page has its three columns, as shell/page.css has it. */
import { signal } from "@preact/signals";

const query = matchMedia("(min-width: 1100px)");
export const wide = signal(query.matches);

query.addEventListener("change", () => {
  wide.value = query.matches;
});
