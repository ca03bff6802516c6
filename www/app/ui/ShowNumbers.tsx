import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";

interface Props {
  label?: string;
  /** The table; created when it is opened, since it may be long. */
  children: () => ComponentChildren;
}

/** Folded table with the numbers of a plot. */
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
