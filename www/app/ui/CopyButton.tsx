import { useSignal } from "@preact/signals";
import { spoken } from "../state/state";
import { copyText } from "./download";

interface Props {
  /** On the button. */
  label: string;
  text: () => string;
  /** Once it is done. */
  done?: string;
  primary?: boolean;
  autofocus?: boolean;
}

/** Copies, and says so where it was pressed. */
export function CopyButton({ label, text, done = "Copied", primary, autofocus }: Props) {
  const said = useSignal("");
  const copy = async () => {
    const copied = await copyText(text());
    said.value = copied ? done : "Select it and copy: the browser does not allow it here";
    spoken.value = said.value;
    setTimeout(() => {
      said.value = "";
    }, 2500);
  };
  return (
    <button
      type="button"
      class={primary ? "primary" : ""}
      autofocus={autofocus}
      onClick={() => void copy()}
    >
      {said.value || label}
    </button>
  );
}
