import { useEffect, useRef } from "preact/hooks";
import { painting, tab } from "../state/state";
import { TABS, type Tab } from "../state/view";

const NAMES: Record<Tab, string> = {
  regions: "Regions",
  explore: "Explore",
  measures: "Measures",
  evidence: "Evidence",
  diagnostics: "Diagnostics",
  models: "Models",
};

/** The tabs of a comparison: regions, explore, measures, evidence, diagnostics, models. */
export function Tabs() {
  const list = useRef<HTMLElement>(null);
  const shown = tab.value;
  // On narrow screens only the list scrolls sideways, not the page.
  useEffect(() => {
    const current = list.current?.querySelector<HTMLElement>(`[data-tab="${shown}"]`);
    if (list.current && current) {
      list.current.scrollLeft = current.offsetLeft + current.offsetWidth - list.current.clientWidth;
    }
  }, [shown]);
  return (
    <nav ref={list} class="tabs" aria-label="Views">
      {TABS.map((name) => (
        <button
          key={name}
          type="button"
          data-tab={name}
          aria-current={tab.value === name ? "page" : undefined}
          disabled={painting.value !== null && tab.value !== name}
          onClick={() => {
            tab.value = name;
          }}
        >
          {NAMES[name]}
        </button>
      ))}
    </nav>
  );
}
