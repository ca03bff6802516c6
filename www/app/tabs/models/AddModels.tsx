import type { DroppedFile } from "../../../worker/protocol";
import { readingSentence } from "../../comparison/words";
import { addModels, cancelAdding, keepCompared } from "../../models/list/actions";
import { isUsed } from "../../models/list/order";
import { modelsIn } from "../../models/opening";
import { demoSource, first } from "../../models/sources";
import { DEMO_GROUPS } from "../../state/demos";
import { addingModels, modelList } from "../../state/state";
import { FileButton } from "../../ui/FileButton";

/** Buttons that add models to the model list: files, folders and examples. */
export function AddModels() {
  const used = isUsed(modelList.value);
  return (
    <div class="add-models">
      <div class="toolbar">
        <Opener label="Add models…" name="Files of models to add" primary={!used} />
        <Opener label="Add a folder…" name="Folder of models or shapes to add" folder />
        <Examples />
        <span class="grow" />
        {used && (
          <button type="button" class="quiet" onClick={keepCompared}>
            Close all but A and B
          </button>
        )}
      </div>
      {addingModels.value ? <Adding /> : !used && <Hint />}
    </div>
  );
}

function Hint() {
  return (
    <p class="small">
      A and B are in the list. Add more models with the same points in the same order to compare
      every pair; each cell opens as a comparison.
    </p>
  );
}

/** Progress of opening models, with a button to cancel. */
function Adding() {
  const found = addingModels.value;
  if (!found) return null;
  const { name, read, done, of } = found;
  const share = read?.of ? Math.min(1, read.bytes / read.of) : 0;
  return (
    <div class="working">
      <p class="run-state">
        Opening <strong>{name}</strong>, {done + 1} of {of}: {readingSentence(read)}
      </p>
      <progress class="bar" value={done + share} max={of} aria-label="Opening models" />
      <button type="button" onClick={cancelAdding}>
        Cancel<span class="unseen"> opening models</span>
      </button>
    </div>
  );
}

interface OpenerProps {
  label: string;
  name: string;
  folder?: boolean;
  primary?: boolean;
}

function Opener({ label, name, folder = false, primary = false }: OpenerProps) {
  const add = async (files: DroppedFile[]) => {
    const models = files.length > 0 ? await modelsIn(files, null) : null;
    if (models) await addModels(models.map(({ source }) => first(source)));
  };
  return (
    <FileButton
      label={name}
      className={primary ? "primary" : ""}
      folder={folder}
      disabled={addingModels.value !== null}
      onFiles={(files) => void add(files)}
    >
      {label}
    </FileButton>
  );
}

/** Adds models of the examples, one or a group at once. */
function Examples() {
  const open = new Set(
    modelList.value.flatMap(({ source }) => (source.kind === "demo" ? source.name : [])),
  );
  const groups = DEMO_GROUPS.map(({ label, demos }) => ({
    label,
    names: demos.flatMap(({ a, b }) => [a, b]).filter((name) => !open.has(name)),
  })).filter(({ names }) => names.length > 0);
  const choose = (names: string[]) => void addModels(names.map((name) => first(demoSource(name))));
  return (
    <select
      aria-label="Add examples"
      value=""
      disabled={addingModels.value !== null || groups.length === 0}
      onChange={(event) => {
        const [label, name] = event.currentTarget.value.split("/");
        const group = groups.find((one) => one.label === label);
        event.currentTarget.value = "";
        if (group) choose(name ? [name] : group.names);
      }}
    >
      <option value="">Add examples…</option>
      {groups.map(({ label, names }) => (
        <optgroup key={label} label={label}>
          {names.length > 1 && <option value={`${label}/`}>All {names.length} of them</option>}
          {names.map((name) => (
            <option key={name} value={`${label}/${name}`}>
              {name}
            </option>
          ))}
        </optgroup>
      ))}
    </select>
  );
}
