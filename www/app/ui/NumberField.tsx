import { useSignal } from "@preact/signals";

interface Props {
  label: string;
  value: number | null;
  least: number;
  most: number;
  /** Placeholder, if the field may be empty. */
  placeholder?: string;
  onChange: (value: number | null) => void;
}

/** Field for a whole number with a label, applied on Enter or when the field is left. */
export function NumberField({ label, value, least, most, placeholder, onChange }: Props) {
  const wrong = useSignal(false);
  const take = (text: string) => {
    const number = text.trim() === "" ? null : Number(text);
    const fits =
      number === null
        ? placeholder !== undefined
        : Number.isInteger(number) && number >= least && number <= most;
    wrong.value = !fits;
    if (fits && number !== value) onChange(number);
  };
  return (
    <label class="number-field" data-wrong={wrong.value}>
      <span>{label}</span>
      <input
        type="number"
        min={least}
        max={most}
        step={1}
        value={value ?? ""}
        placeholder={placeholder}
        aria-invalid={wrong.value}
        onChange={(event) => take(event.currentTarget.value)}
      />
      {wrong.value && (
        <output class="wrong">
          {least} to {most}
        </output>
      )}
    </label>
  );
}
