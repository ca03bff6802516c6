import { useSignal } from "@preact/signals";
import { Field } from "./Field";

interface Props<T> {
  label: string;
  /** Accessible name, if the label is used for several fields. */
  accessibleLabel?: string | undefined;
  value: string;
  standard: string;
  parse: (text: string) => T | "invalid";
  onChange: (value: T) => void;
  /** Expected input, shown when something else is typed. */
  wrong: string;
  placeholder?: string;
  suffix?: string;
  standardWord?: string;
  help?: string;
}

/** Field for a typed value, applied on Enter or when the field is left. */
export function TypedField<T>(props: Props<T>) {
  const {
    label,
    value,
    standard,
    parse,
    onChange,
    wrong,
    placeholder = "",
    suffix,
    help,
    standardWord,
    accessibleLabel = label,
  } = props;
  const invalid = useSignal(false);
  const take = (text: string) => {
    if (text === value) return;
    const parsed = parse(text);
    invalid.value = parsed === "invalid";
    if (parsed !== "invalid") onChange(parsed);
  };
  const reset = () => {
    invalid.value = false;
    const parsed = parse(standard);
    if (parsed !== "invalid") onChange(parsed);
  };
  const about = `${accessibleLabel.replace(/\W+/g, "-").toLowerCase()}-about`;
  return (
    <Field
      label={label}
      changed={value !== standard}
      onReset={reset}
      help={help}
      standardWord={standardWord}
    >
      <input
        type="text"
        inputMode="decimal"
        aria-label={accessibleLabel}
        aria-invalid={invalid.value}
        aria-describedby={about}
        value={value}
        placeholder={placeholder}
        onChange={(event) => take(event.currentTarget.value)}
        onDblClick={reset}
        autocomplete="off"
        spellcheck={false}
      />
      <span id={about} class="suffix" data-wrong={invalid.value}>
        {invalid.value ? wrong : suffix}
      </span>
    </Field>
  );
}
