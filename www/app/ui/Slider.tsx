interface Props {
  label: string;
  /** Accessible name, if it is not the label. */
  name?: string;
  value: number;
  least: number;
  most: number;
  step: number;
  /** The value in words, for screen readers. */
  words: string;
  /** The value as it is shown beside the slider. */
  shown?: string;
  /** Called while the slider moves. */
  onMove?: (value: number) => void;
  /** Called when it is let go. */
  onSettle?: (value: number) => void;
  /** Called on a double click. */
  onReset?: () => void;
}

/** Slider with its label and its value. */
export function Slider(props: Props) {
  const { label, name, value, least, most, step, words, shown, onMove, onSettle, onReset } = props;
  return (
    <label class="slider">
      <span>{label}</span>
      <input
        type="range"
        min={least}
        max={most}
        step={step}
        value={value}
        aria-label={name}
        aria-valuetext={words}
        onInput={onMove && ((event) => onMove(Number(event.currentTarget.value)))}
        onChange={onSettle && ((event) => onSettle(Number(event.currentTarget.value)))}
        onDblClick={onReset}
      />
      {shown !== undefined && <span class="num">{shown}</span>}
    </label>
  );
}
