import { modelList } from "../../state/state";
import { AddModels } from "./AddModels";
import { Matrix } from "./Matrix";
import { ModelListTable } from "./ModelListTable";

/** The tab Models: the list of open models and the table of all pairs. */
export function ModelTable() {
  return (
    <section class="tab several" aria-label="Models">
      <AddModels />
      <ModelListTable />
      {modelList.value.length > 1 && <Matrix />}
    </section>
  );
}
