import { signal } from "@preact/signals";
import { FigureDialog } from "./FigureDialog";
import { FilmDialog } from "./FilmDialog";

/** Which picture is being made, if one is. */
export const taking = signal<"figure" | "film" | null>(null);

export function Taking() {
  const close = () => {
    taking.value = null;
  };
  if (taking.value === "figure") return <FigureDialog onClose={close} />;
  return taking.value === "film" ? <FilmDialog onClose={close} /> : null;
}
