import { ROOMS, type Room } from "../link";
import { painting, room } from "../state";

const NAMES: Record<Room, string> = {
  regions: "Regions",
  explore: "Explore",
  measures: "Measures",
  diagnostics: "Diagnostics",
  models: "Models",
};

/** On a phone not all of them are in sight at once. */
function show(element: HTMLElement | null): void {
  element?.scrollIntoView({ block: "nearest", inline: "nearest" });
}

/** Parts of the page: each looks at the same comparison in its own way. */
export function Rooms() {
  return (
    <nav class="rooms" aria-label="Views">
      {ROOMS.map((name) => (
        <button
          key={name}
          type="button"
          ref={room.value === name ? show : null}
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
