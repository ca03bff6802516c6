import { useRef } from "preact/hooks";
import { filesOf } from "../folders";
import { openFiles } from "../intake";
import type { Side } from "../state";

/** Files, as many as belong together; or a folder of them. */
export function OpenButtons({ side }: { side: Side }) {
  const name = side.toUpperCase();
  return (
    <div class="open-buttons">
      <Opener side={side} className="open" label={`File for model ${name}`}>
        Open model…<span class="unseen"> for {name}</span>
      </Opener>
      <Opener side={side} className="as-link" label={`Folder for model ${name}`} folder>
        Open folder…<span class="unseen"> for {name}</span>
      </Opener>
    </div>
  );
}

interface Props {
  side: Side;
  className: string;
  label: string;
  folder?: boolean;
  children: preact.ComponentChildren;
}

function Opener({ side, className, label, folder = false, children }: Props) {
  const input = useRef<HTMLInputElement>(null);
  // No `accept`: iOS greys out files of types it does not know.
  return (
    <>
      <button type="button" class={className} onClick={() => input.current?.click()}>
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
          void openFiles(filesOf(event.currentTarget.files ?? []), side);
          event.currentTarget.value = "";
        }}
      />
    </>
  );
}
