import type { ComponentChildren } from "preact";

interface Props {
  checked: boolean;
  title?: string;
  onChange: (checked: boolean) => void;
  children: ComponentChildren;
}

/** Checkbox with its label. */
export function Check({ checked, title, onChange, children }: Props) {
  return (
    <label class="check" title={title}>
      <input
        type="checkbox"
        checked={checked}
        onChange={(event) => onChange(event.currentTarget.checked)}
      />
      {children}
    </label>
  );
}
