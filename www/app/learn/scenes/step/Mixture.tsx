import { MIXTURE, SCALING } from "../../sampling/names";

/** The component of the mixture that made the proposal. */
export function Mixture({ part }: { part: number | undefined }) {
  return (
    <div class="step-mixture">
      <ol>
        {MIXTURE.map(({ name, share }, i) => (
          <li key={name} data-on={i === part}>
            {name} <span class="dim">{Math.round(100 * share)}&#8239;%</span>
          </li>
        ))}
      </ol>
      <p class="small">
        Proposed by {part === undefined ? "…" : MIXTURE[part]?.about}
        {part === SCALING ? ": along the ray from the mean." : "."}
      </p>
    </div>
  );
}
