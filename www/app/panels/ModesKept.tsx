import type { Side } from "../../worker/protocol";
import { keptModes } from "../state/preparation";
import { parseCount, rangeOf } from "../state/settings";
import { change, settings } from "../state/state";
import { count } from "../text/format";

const SHARES = [0.9, 0.95, 0.99];

/** Chooses how many modes of one model are compared: all, the first ones, or those for a share of the variance. */
export function ModesKept({ side, deviations }: { side: Side; deviations: number[] }) {
  const now = settings.value.prepare[side];
  const letter = side.toUpperCase();
  const by = now.variance !== null ? String(now.variance) : now.modes !== null ? "first" : "all";
  const kept = keptModes(deviations, now);
  const choose = (choice: string) => {
    const variance = SHARES.find((share) => String(share) === choice) ?? null;
    const modes = choice === "first" ? kept : null;
    change({ prepare: { [side]: { variance, modes } } });
  };
  const take = (input: HTMLInputElement) => {
    const modes = parseCount(input.value, rangeOf("modes")[0], deviations.length);
    input.setAttribute("aria-invalid", String(modes === "invalid"));
    if (modes !== "invalid") change({ prepare: { [side]: { modes, variance: null } } });
  };
  const odd = now.variance !== null && !SHARES.includes(now.variance);
  return (
    <div class="card-row modes-kept">
      <select
        aria-label={`Modes of ${letter} that are compared`}
        value={by}
        onChange={(event) => choose(event.currentTarget.value)}
      >
        <option value="all">all {count(deviations.length)} modes</option>
        {odd && <option value={by}>{percentText(now.variance ?? 1)}</option>}
        {SHARES.map((share) => (
          <option key={share} value={String(share)}>
            {percentText(share)}
          </option>
        ))}
        <option value="first">the first modes</option>
      </select>
      {by === "first" ? (
        <input
          type="text"
          inputMode="numeric"
          aria-label={`How many modes of ${letter}`}
          value={String(now.modes)}
          onChange={(event) => take(event.currentTarget)}
          autocomplete="off"
        />
      ) : (
        by !== "all" && <span class="suffix">{kept === 1 ? "1 mode" : `${count(kept)} modes`}</span>
      )}
    </div>
  );
}

function percentText(share: number): string {
  return `${Number((100 * share).toPrecision(12))}\u202f% of the variance`;
}
