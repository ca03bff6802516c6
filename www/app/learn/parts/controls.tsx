/** Controls of the scenes: sliders, numbers of the engine, buttons to run, step and reset. */
import type { ComponentChildren } from "preact";
import { number as shown } from "../../text/format";

interface SliderProps {
  label: string;
  value: number;
  least: number;
  most: number;
  step: number;
  /** Whether the scale is logarithmic: σ, counts. */
  logarithmic?: boolean;
  show?: (value: number) => string;
  onChange: (value: number) => void;
}

/** Slider with its value; on a logarithmic scale a step is a factor. */
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
  /** Path of the number in the output of `shapevenn lesson`. */
  metric: string;
  value: number | null | undefined;
  show?: (value: number) => string;
  /** Short explanation. */
  note?: ComponentChildren;
}

/** A number from the engine, rounded on the page, unrounded in `data-value`. */
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

/** Buttons to run or pause, to make one step, and to reset. */
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
