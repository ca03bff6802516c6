import { useSignal } from "@preact/signals";
import type { Download, Region } from "../../worker/protocol";
import { shapeCount } from "../comparison/run";
import { saveRun } from "../link/runfile/run";
import { REGION_NAMES } from "../stage/names";
import { REGIONS } from "../state/regions";
import {
  engine,
  exaggeration,
  held,
  picture,
  result,
  run,
  shapes,
  shapesSeed,
} from "../state/state";
import { download, saveText } from "../ui/download";
import { FileButton } from "../ui/FileButton";
import { Select } from "../ui/Select";
import { openFiles } from "./dropped-files";
import { Methods, Pictures } from "./Pictures";

/** What can be downloaded, and in which file formats. */
const KINDS: { of: string; files: [ending: string, kind: Download["kind"], help: string][] }[] = [
  {
    of: "A∩B",
    files: [
      [".h5", "intersection-h5", "Model for statismo and Scalismo before version 1"],
      [".h5.json", "intersection-json", "Model for Scalismo from version 1 on"],
      [".npz", "intersection-npz", "Model as NumPy arrays"],
      [".json", "intersection-plain-json", "Model as plain numbers, for any language"],
      [".glb", "intersection-glb", "Mean and modes as morph targets, for 3-D programs"],
    ],
  },
  {
    of: "Draws",
    files: [
      [".npz", "draws-npz", "Coefficients of all draws as NumPy arrays"],
      [".json", "draws-json", "Coefficients of all draws as plain numbers"],
      [".csv", "draws-csv", "Coefficients of all draws as a table"],
    ],
  },
];

export function Downloads() {
  const shown = result.value;
  const ready = engine.value !== null && !run.value && Object.keys(shapes.value).length > 0;
  return (
    <section class="downloads" aria-label="Downloads">
      <h3>Download</h3>
      {KINDS.map(({ of, files }) => (
        <fieldset key={of} class="download-row">
          <legend>{of}</legend>
          {files.map(([ending, kind, help]) => (
            <Save key={kind} what={{ kind } as Download} {...{ of, ending, help, ready }} />
          ))}
        </fieldset>
      ))}
      <fieldset class="download-row">
        <legend>Report</legend>
        <button
          type="button"
          aria-label="Report .json"
          title="All numbers of the page, unrounded"
          disabled={shown === null}
          onClick={() => shown && saveText("shapevenn-report.json", shown.text)}
        >
          .json
        </button>
        <Save
          what={{ kind: "report-csv" }}
          of="Report"
          ending=".csv"
          help="All numbers as a table"
          ready={ready}
        />
      </fieldset>
      <RunFileRow ready={ready} />
      <Shape ready={ready} />
      <Pictures ready={ready} />
      <Methods />
    </section>
  );
}

/** The run file: models and settings that reproduce this comparison exactly. */
function RunFileRow({ ready }: { ready: boolean }) {
  // The engine writes the run file of the comparison that it holds.
  const holds = ready && held.value !== null && held.value.key === result.value?.key;
  return (
    <fieldset class="download-row">
      <legend>Run file</legend>
      <button
        type="button"
        aria-label="Run file .json"
        title="Models by name and fingerprint, and every setting: open it again for the same numbers"
        disabled={!holds}
        onClick={() => void saveRun()}
      >
        .json
      </button>
      <FileButton
        className="as-link"
        label="Run file or report, with its models or without"
        onFiles={(files) => void openFiles(files, "a")}
      >
        Open a run file…
      </FileButton>
    </fieldset>
  );
}

interface SaveProps {
  what: Download;
  of: string;
  ending: string;
  help: string;
  ready: boolean;
}

function Save({ what, of, ending, help, ready }: SaveProps) {
  return (
    <button
      type="button"
      aria-label={`${of} ${ending}`}
      title={help}
      disabled={!ready}
      onClick={() => void download(what)}
    >
      {ending}
    </button>
  );
}

const MESHES = ["ply", "obj", "glb"] as const;

/** Downloads one shape as it is drawn, exaggerated or not. */
function Shape({ ready }: { ready: boolean }) {
  const from = useSignal<Region>("intersection");
  const index = useSignal(-1);
  const shown = Math.min(9, shapes.value[from.value]?.count ?? 0);
  const what = (kind: (typeof MESHES)[number]): Download => ({
    kind,
    region: from.value,
    index: index.value,
    count: shapeCount(),
    seed: shapesSeed.value,
    exaggeration: exaggeration.value,
    picture: picture.value,
  });
  return (
    <fieldset class="download-row">
      <legend>Shape</legend>
      <Select
        label="Region of the shape"
        value={from.value}
        options={REGIONS.map((name) => [name, REGION_NAMES[name].sign])}
        onChoose={(name) => {
          from.value = name;
        }}
      />
      <Select
        label="Which shape of the region"
        value={String(index.value)}
        options={[
          ["-1", "mean"],
          ...Array.from({ length: shown }, (_, i) => [String(i), `sample ${i + 1}`] as const),
        ]}
        onChoose={(chosen) => {
          index.value = Number(chosen);
        }}
      />
      {MESHES.map((kind) => (
        <Save
          key={kind}
          what={what(kind)}
          of="Shape"
          ending={`.${kind}`}
          help="This shape as it is drawn"
          ready={ready}
        />
      ))}
    </fieldset>
  );
}
