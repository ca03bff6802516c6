import type { Side } from "../../worker/protocol";
import { FileButton } from "../ui/FileButton";
import { openFiles } from "./dropped-files";

/** Buttons that open a model from one or several files, or from a folder. */
export function OpenButtons({ side }: { side: Side }) {
  const name = side.toUpperCase();
  return (
    <div class="open-buttons">
      <FileButton
        className="open"
        label={`File for model ${name}`}
        onFiles={(files) => void openFiles(files, side)}
      >
        Open model…<span class="unseen"> for {name}</span>
      </FileButton>
      <FileButton
        className="as-link"
        label={`Folder for model ${name}`}
        folder
        onFiles={(files) => void openFiles(files, side)}
      >
        Open folder…<span class="unseen"> for {name}</span>
      </FileButton>
    </div>
  );
}
