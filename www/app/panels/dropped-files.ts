/** Opens dropped or chosen files: models, a run file, or a run file with its models. */
import type { DroppedFile, Side } from "../../worker/protocol";
import { openRun, runAmong } from "../link/runfile/run";
import { openModels } from "../models/opening";
import { page } from "../state/state";

/** Folders of shapes have no run file among them. */
const MOST_LOOKED_INTO = 20;

export async function openFiles(files: DroppedFile[], side: Side): Promise<void> {
  if (page.peek() !== "compare") {
    // Opened models are shown on the page Compare. It first opens the models of the link, which the dropped files
    // then replace.
    page.value = "compare";
    await Promise.resolve();
  }
  const run = files.length <= MOST_LOOKED_INTO ? await runAmong(files) : null;
  const models = files.filter((file) => file !== run?.file);
  if (run) await openRun(run.file.name, run.text, models.length > 0);
  await openModels(models, side);
}
