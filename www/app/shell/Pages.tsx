import { begun, page, painting } from "../state/state";
import { PAGES, type PageName } from "../state/view";

const NAMES: Record<PageName, string> = {
  compare: "Compare",
  learn: "Learn",
  gallery: "Gallery",
};

/** Navigation between comparison, lessons and gallery. Links, so that each can be opened in a new window. */
export function Pages() {
  return (
    <nav class="pages" aria-label="Pages">
      {PAGES.map((name) => (
        <a
          key={name}
          href={name === "compare" ? "#v=1" : `#v=1&page=${name}`}
          aria-current={page.value === name ? "page" : undefined}
          data-page={name}
          onClick={(event) => {
            if (event.ctrlKey || event.metaKey || event.shiftKey) return;
            // Returns to the present comparison instead of starting a new one.
            if (name === "compare" && !begun.value) return;
            event.preventDefault();
            if (painting.value === null) page.value = name;
          }}
        >
          {NAMES[name]}
        </a>
      ))}
    </nav>
  );
}
