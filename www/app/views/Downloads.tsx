import { useSignal } from "@preact/signals";
import type { ExportKind, Region } from "../../worker/protocol";
import { shapeCount } from "../comparison";
import { download, saveText } from "../download";
import { REGIONS } from "../link";
import { engine, result, run, shapes, shapesSeed } from "../state";
import { REGION_NAMES } from "./names";

export function Downloads() {
  const held = result.value;
  const ready = engine.value !== null && !run.value && Object.keys(shapes.value).length > 0;
  return (
    <section class="downloads" aria-label="Downloads">
      <h3>Take away</h3>
      <div class="download-row">
        <Save what={{ kind: "intersection-h5" }} label="A∩B .h5" ready={ready} />
        <Save what={{ kind: "intersection-npz" }} label="A∩B .npz" ready={ready} />
        <Save what={{ kind: "draws-npz" }} label="Draws .npz" ready={ready} />
        <button
          type="button"
          disabled={held === null}
          onClick={() => held && saveText("shapevenn-report.json", held.text)}
        >
          Report .json
        </button>
      </div>
      <Ply ready={ready} />
    </section>
  );
}

function Save({ what, label, ready }: { what: ExportKind; label: string; ready: boolean }) {
  return (
    <button type="button" disabled={!ready} onClick={() => void download(what)}>
      {label}
    </button>
  );
}

function Ply({ ready }: { ready: boolean }) {
  const from = useSignal<Region>("intersection");
  const index = useSignal(-1);
  const shown = Math.min(9, shapes.value[from.value]?.count ?? 0);
  const save = () =>
    download({
      kind: "ply",
      region: from.value,
      index: index.value,
      count: shapeCount(),
      seed: shapesSeed.value,
    });
  return (
    <div class="download-row">
      <select
        aria-label="Region of the PLY file"
        value={from.value}
        onChange={(event) => {
          from.value = event.currentTarget.value as Region;
        }}
      >
        {REGIONS.map((name) => (
          <option key={name} value={name}>
            {REGION_NAMES[name].sign}
          </option>
        ))}
      </select>
      <select
        aria-label="Shape of the PLY file"
        value={String(index.value)}
        onChange={(event) => {
          index.value = Number(event.currentTarget.value);
        }}
      >
        <option value="-1">mean</option>
        {Array.from({ length: shown }, (_, i) => (
          <option key={String(i)} value={String(i)}>
            sample {i + 1}
          </option>
        ))}
      </select>
      <button type="button" disabled={!ready} onClick={() => void save()}>
        Shape .ply
      </button>
    </div>
  );
}
