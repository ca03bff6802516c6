/** What can be set in a scene, with the number beside it. */
import type { ComponentChildren } from "preact";
import { number as shown } from "../../text/format";

interface SliderProps {
  label: string;
  value: number;
  least: number;
  most: number;
  step: number;
  /** Slides over the logarithm: σ, counts. */
  logarithmic?: boolean;
  show?: (value: number) => string;
  onChange: (value: number) => void;
}

/** A native range input; where it is logarithmic, a step is a factor. */
export function Slider(props: SliderProps) {
  const { label, value, least, most, step, logarithmic = false, onChange } = props;
  const show = props.show ?? shown;
  const into = logarithmic ? Math.log10 : (v: number) => v;
  const out = logarithmic ? (v: number) => 10 ** v : (v: number) => v;
  return (
    <label class="lesson-slider">
      <span class="lesson-label">{label}</span>
      <input
        type="range"
        min={into(least)}
        max={into(most)}
        step={logarithmic ? 0.01 : step}
        value={into(value)}
        aria-valuetext={show(value)}
        onInput={(event) => onChange(out(Number(event.currentTarget.value)))}
      />
      <output class="num">{show(value)}</output>
    </label>
  );
}

interface NumberProps {
  label: string;
  /** Path of what the engine answered, as the command line prints it. */
  metric: string;
  value: number | null | undefined;
  show?: (value: number) => string;
  /** What it means, in a few words. */
  note?: ComponentChildren;
}

/** A number of the engine’s, rounded on the page, whole in `data-value`. */
export function LessonNumber({ label, metric, value, show = shown, note }: NumberProps) {
  const known = value != null && Number.isFinite(value);
  return (
    <div class="lesson-number">
      <dt>{label}</dt>
      <dd data-metric={metric} data-value={known ? value : undefined}>
        {known ? show(value) : "–"}
      </dd>
      {note && <dd class="small">{note}</dd>}
    </div>
  );
}

export function LessonNumbers({ children, label }: { children: ComponentChildren; label: string }) {
  return (
    <dl class="lesson-numbers" aria-label={label}>
      {children}
    </dl>
  );
}

interface PlayProps {
  playing: boolean;
  onToggle: () => void;
  onStep?: () => void;
  onReset?: () => void;
  children?: ComponentChildren;
}

/** Run or pause, one step, from the start. */
export function PlayBar({ playing, onToggle, onStep, onReset, children }: PlayProps) {
  return (
    <div class="play-bar">
      <button type="button" class="primary" onClick={onToggle} aria-keyshortcuts="Space">
        {playing ? "Pause" : "Run"}
      </button>
      {onStep && (
        <button type="button" onClick={onStep} disabled={playing} aria-keyshortcuts="S">
          One step
        </button>
      )}
      {onReset && (
        <button type="button" class="quiet" onClick={onReset} aria-keyshortcuts="R">
          Reset
        </button>
      )}
      {children}
    </div>
  );
}
