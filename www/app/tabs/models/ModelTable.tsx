import { shelf } from "../../state/state";
import { AddModels } from "./AddModels";
import { Matrix } from "./Matrix";
import { ShelfTable } from "./ShelfTable";

/** Several models at once: which are open, and how each lies to each other one. */
export function ModelTable() {
  return (
    <section class="room several" aria-label="Models">
      <AddModels />
      <ShelfTable />
      {shelf.value.length > 1 && <Matrix />}
    </section>
  );
}
