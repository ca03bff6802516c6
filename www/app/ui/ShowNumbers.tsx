import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";

interface Props {
  label?: string;
  /** Made once it is looked at: tables of hundreds of modes are long. */
  children: () => ComponentChildren;
}

/** The table behind a plot. */
export function ShowNumbers({ label = "Show numbers", children }: Props) {
  const open = useSignal(false);
  return (
    <details
      onToggle={(event) => {
        open.value = event.currentTarget.open;
      }}
    >
      <summary>{label}</summary>
      {open.value && children()}
    </details>
  );
}
