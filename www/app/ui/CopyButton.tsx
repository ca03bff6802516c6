import { useSignal } from "@preact/signals";
import { spoken } from "../state/state";
import { copyText } from "./download";

interface Props {
  /** Label of the button. */
  label: string;
  text: () => string;
  /** Label after copying. */
  done?: string;
  primary?: boolean;
  autofocus?: boolean;
}

/** Button that copies a text and says so on itself. */
export function CopyButton({ label, text, done = "Copied", primary, autofocus }: Props) {
  const said = useSignal("");
  const copy = async () => {
    const copied = await copyText(text());
    said.value = copied
      ? done
      : "Select and copy the text yourself: the browser does not allow copying here";
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
