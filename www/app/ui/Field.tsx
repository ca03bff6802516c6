import type { ComponentChildren } from "preact";

interface FieldProps {
  label: string;
  changed: boolean;
  onReset: () => void;
  help?: string | undefined;
  /** Name of the default. */
  standardWord?: string | undefined;
  children: ComponentChildren;
}

/** A setting with its name, its input, and a button that resets it to the default. */
export function Field({
  label,
  changed,
  onReset,
  help,
  standardWord = "default",
  children,
}: FieldProps) {
  return (
    <div class="field" data-changed={changed} title={help}>
      <span class="field-label" aria-hidden="true">
        {label}
      </span>
      <div class="field-input">{children}</div>
      {changed ? (
        <button type="button" class="reset" onClick={onReset}>
          reset<span class="unseen"> {label} to its default</span>
        </button>
      ) : (
        <span class="standard">{standardWord}</span>
      )}
    </div>
  );
}
