import { useEffect, useRef } from "preact/hooks";
import { painting, room } from "../state/state";
import { ROOMS, type Room } from "../state/view";

const NAMES: Record<Room, string> = {
  regions: "Regions",
  explore: "Explore",
  measures: "Measures",
  diagnostics: "Diagnostics",
  models: "Models",
};

/** Parts of the page: each looks at the same comparison in its own way. */
export function Rooms() {
  const list = useRef<HTMLElement>(null);
  const shown = room.value;
  // On narrow screens the list scrolls sideways, and only that: the page stays where it is.
  useEffect(() => {
    const current = list.current?.querySelector<HTMLElement>(`[data-room="${shown}"]`);
    if (list.current && current) {
      list.current.scrollLeft = current.offsetLeft + current.offsetWidth - list.current.clientWidth;
    }
  }, [shown]);
  return (
    <nav ref={list} class="rooms" aria-label="Views">
      {ROOMS.map((name) => (
        <button
          key={name}
          type="button"
          data-room={name}
          aria-current={room.value === name ? "page" : undefined}
          disabled={painting.value !== null && room.value !== name}
          onClick={() => {
            room.value = name;
          }}
        >
          {NAMES[name]}
        </button>
      ))}
    </nav>
  );
}
