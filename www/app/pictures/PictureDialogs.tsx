import { signal } from "@preact/signals";
import { FigureDialog } from "./FigureDialog";
import { FilmDialog } from "./FilmDialog";

/** The open dialog: for figures, for animations, or none. */
export const pictureDialog = signal<"figure" | "film" | null>(null);

/** Shows the open dialog for figures or animations. */
export function PictureDialogs() {
  const close = () => {
    pictureDialog.value = null;
  };
  if (pictureDialog.value === "figure") return <FigureDialog onClose={close} />;
  return pictureDialog.value === "film" ? <FilmDialog onClose={close} /> : null;
}
