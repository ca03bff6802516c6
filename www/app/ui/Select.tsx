interface Props<T extends string> {
  /** Accessible name, where no label is around it. */
  label?: string;
  title?: string;
  class?: string;
  /** Id of what explains the choice. */
  describedBy?: string;
  value: T;
  /** Values with their labels. */
  options: readonly (readonly [T, string])[];
  onChoose: (value: T) => void;
}

/** A list of which one is chosen. */
export function Select<T extends string>(props: Props<T>) {
  const { label, title, describedBy, value, options, onChoose } = props;
  return (
    <select
      aria-label={label}
      aria-describedby={describedBy}
      title={title}
      class={props.class}
      value={value}
      onChange={({ currentTarget }) => {
        const chosen = options.find(([option]) => option === currentTarget.value);
        if (chosen) onChoose(chosen[0]);
      }}
    >
      {options.map(([option, name]) => (
        <option key={option} value={option}>
          {name}
        </option>
      ))}
    </select>
  );
}
