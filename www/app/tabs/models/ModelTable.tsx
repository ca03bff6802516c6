import { modelList } from "../../state/state";
import { AddModels } from "./AddModels";
import { Matrix } from "./Matrix";
import { ModelListTable } from "./ModelListTable";

/** Several models: the list of those that are open, and a table of every pair. */
export function ModelTable() {
  return (
    <section class="tab several" aria-label="Models">
      <AddModels />
      <ModelListTable />
      {modelList.value.length > 1 && <Matrix />}
    </section>
  );
}
