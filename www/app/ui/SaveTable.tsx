import type { ComponentChildren } from "preact";
import { useRef } from "preact/hooks";
import { csvText, rowsOf } from "../text/csv";
import { saveBlob } from "./download";

interface Props {
  /** Of the file, without its ending. */
  file: string;
  /** What a screen reader is told that the file holds. */
  of: string;
  children: ComponentChildren;
}

/** A table that can be taken away as CSV, with all digits of what it shows. */
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
