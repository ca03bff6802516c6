import { computed } from "@preact/signals";
import { takeSigma, trySigma } from "../comparison/run";
import { recommended, result, settings, tried } from "../state/state";

/** Range of the axis of σ above and below the recommended σ, in powers of ten. */
const DECADES = 2;
const STEP = 0.02;

/** Middle of the axis of σ: the recommended one. */
export const middleSigma = computed(
  () => recommended.value ?? result.value?.report.settings.sigma ?? null,
);

/** The σ of the handles: the previewed one, else the chosen one. */
export const shownSigma = computed(() => tried.value ?? settings.value.sigma ?? middleSigma.value);

/** Least and largest σ of the axis. */
export function axisOf(middle: number): readonly [number, number] {
  return [middle / 10 ** DECADES, middle * 10 ** DECADES];
}

interface Props {
  label: string;
  /** The value in words, for screen readers. */
  words: string;
  middle: number;
  sigma: number;
  className?: string;
}

/** Handle on a logarithmic axis of σ: moving it previews, letting it go runs. */
export function SigmaRange({ label, words, middle, sigma, className }: Props) {
  const power = Math.max(-DECADES, Math.min(DECADES, Math.log10(sigma / middle)));
  const at = (element: HTMLInputElement) => {
    const power = Number(element.value);
    return power === 0 ? middle : Number((middle * 10 ** power).toPrecision(3));
  };
  const take = (element: HTMLInputElement) => {
    const value = at(element);
    takeSigma(value === recommended.value ? null : value);
  };
  // A slider that is moved back to where it was sends no change event.
  const release = ({ currentTarget: element }: { currentTarget: HTMLInputElement }) =>
    setTimeout(() => {
      if (tried.peek() !== null) take(element);
    });
  return (
    <input
      type="range"
      class={className}
      aria-label={label}
      aria-valuetext={words}
      min={-DECADES}
      max={DECADES}
      step={STEP}
      value={power}
      onInput={(event) => trySigma(at(event.currentTarget))}
      onChange={(event) => take(event.currentTarget)}
      onPointerUp={release}
      onPointerCancel={release}
      onBlur={release}
    />
  );
}
