import { modelList } from "../../state/state";
import { AddModels } from "./AddModels";
import { Matrix } from "./Matrix";
import { ModelListTable } from "./ModelListTable";

/** Several models at once: which are open, and how each lies to each other one. */
export function ModelTable() {
  return (
    <section class="tab several" aria-label="Models">
      <AddModels />
      <ModelListTable />
      {modelList.value.length > 1 && <Matrix />}
    </section>
  );
}
