import type { ComponentChildren } from "preact";
import { useRef } from "preact/hooks";
import { csvText, rowsOf } from "../text/csv";
import { saveBlob } from "./download";

interface Props {
  /** Name of the file, without its ending. */
  file: string;
  /** Contents of the file, for screen readers. */
  of: string;
  children: ComponentChildren;
}

/** Adds a button to a table that saves it as CSV with unrounded numbers. */
export function SaveTable({ file, of, children }: Props) {
  const box = useRef<HTMLDivElement>(null);
  return (
    <div class="saved" ref={box}>
      {children}
      <button
        type="button"
        class="quiet save-table"
        title="Save this table as CSV"
        onClick={() => {
          const table = box.current?.querySelector("table");
          if (!table) return;
          saveBlob(`${file}.csv`, new Blob([csvText(rowsOf(table))], { type: "text/csv" }));
        }}
      >
        CSV<span class="unseen"> of {of}</span>
      </button>
    </div>
  );
}
