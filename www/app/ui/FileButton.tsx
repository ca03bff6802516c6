import type { ComponentChildren } from "preact";
import { useRef } from "preact/hooks";
import type { DroppedFile } from "../../worker/protocol";
import { filesOf } from "./folders";

interface Props {
  /** Accessible name of the input. */
  label: string;
  className?: string;
  folder?: boolean;
  disabled?: boolean;
  onFiles: (files: DroppedFile[]) => void;
  children: ComponentChildren;
}

/** Button that opens the file chooser for files or a folder. */
export function FileButton(props: Props) {
  const { label, className = "", folder = false, disabled = false, onFiles, children } = props;
  const input = useRef<HTMLInputElement>(null);
  // No `accept`: iOS greys out files of types it does not know.
  return (
    <>
      <button
        type="button"
        class={className}
        disabled={disabled}
        onClick={() => input.current?.click()}
      >
        {children}
      </button>
      <input
        ref={input}
        class="unseen"
        type="file"
        multiple
        {...(folder ? { webkitdirectory: true } : {})}
        tabIndex={-1}
        aria-label={label}
        onChange={(event) => {
          onFiles(filesOf(event.currentTarget.files ?? []));
          event.currentTarget.value = "";
        }}
      />
    </>
  );
}
