interface Props<T extends string> {
  legend: string;
  name: string;
  value: T;
  /** Values with their labels, and the title of a label if it has one. */
  options: readonly (readonly [T, string, string?])[];
  onChoose: (value: T) => void;
}

/** Radio buttons side by side. */
export function Segments<T extends string>(props: Props<T>) {
  const { legend, name, value, options, onChoose } = props;
  return (
    <fieldset class="segments">
      <legend class="unseen">{legend}</legend>
      {options.map(([option, label, title]) => (
        <label key={option} data-on={value === option} title={title}>
          <input
            type="radio"
            name={name}
            value={option}
            checked={value === option}
            onChange={() => onChoose(option)}
          />
          {label}
        </label>
      ))}
    </fieldset>
  );
}
