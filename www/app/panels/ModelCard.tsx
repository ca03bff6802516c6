import { useEffect, useRef } from "preact/hooks";
import type { DroppedFile, ModelReport, Side } from "../../worker/protocol";
import {
  basisSentence,
  originSentence,
  readingSentence,
  shapesSentence,
  unitSentence,
} from "../comparison/words";
import { askedName } from "../link/waiting";
import {
  addShapes,
  cancelOpening,
  choosePart,
  chooseScale,
  openParts,
  removeShapes,
} from "../models/opening";
import { hasWord } from "../models/reading";
import { nameOfShapes } from "../models/shapes";
import { filesSource, titleOf } from "../models/sources";
import { isSet, readingSpecimens, showSpecimens } from "../models/specimens";
import { cardPicture, drawable } from "../stage/stage-controller";
import { keptModes } from "../state/preparation";
import { otherSide } from "../state/regions";
import {
  demo,
  geometry,
  linked,
  opening,
  partName,
  result,
  type Slot,
  settings,
  slots,
} from "../state/state";
import { isDark } from "../state/theme";
import { bytes, count, length } from "../text/format";
import { Check } from "../ui/Check";
import { FileButton } from "../ui/FileButton";
import { Notices } from "../ui/Notices";
import { Scree } from "../ui/Scree";
import { Select } from "../ui/Select";
import { Findings } from "./Findings";
import { ModesKept } from "./ModesKept";
import { OpenButtons } from "./OpenButtons";

const PICTURE_PX = 84;

/** Card of model A or B: name, format, mean shape, number of points and modes, standard deviations. */
export function ModelCard({ side }: { side: Side }) {
  const slot = slots[side].value;
  // Before the engine has started, the stored report describes both models.
  const report = slot?.report ?? result.value?.report.models[side];
  const ofFile = slot && slot.source.kind !== "demo" ? titleOf(slot) : undefined;
  const asked = linked.value && askedName(linked.value, side);
  const name = ofFile ?? report?.name ?? demo.value?.[side] ?? asked ?? "";
  const busy = opening[side].value;
  return (
    <section
      class="card"
      data-side={side}
      aria-label={`Model ${side.toUpperCase()}`}
      aria-busy={busy !== null}
    >
      <div class="card-head">
        <span class="letter" aria-hidden="true">
          {side.toUpperCase()}
        </span>
        <div class="card-title">
          <h2 title={busy?.name ?? name}>{busy?.name ?? name}</h2>
          <p class="format">
            {busy ? readingSentence(busy.read) : (report?.format ?? "Not open yet")}
          </p>
        </div>
        {busy ? <CancelButton side={side} /> : <OpenButtons side={side} />}
      </div>
      {busy?.read?.of && busy.read.bytes < busy.read.of && (
        <progress
          class="bar"
          value={busy.read.bytes}
          max={busy.read.of}
          aria-label={`Reading ${busy.name}`}
        />
      )}
      <Notices place={side} />
      {slot && slot.parts.length > 1 && <Parts side={side} slot={slot} name={name} />}
      {report && (
        <div class="card-body">
          <Picture side={side} />
          <dl class="facts">
            <Fact term="points" value={count(report.points)} />
            <Fact term="modes" value={count(report.modes)} />
            <Fact term="size" value={length(report.size, report.unit)} />
            {slot?.bytes && <Fact term="file" value={bytes(slot.bytes)} />}
          </dl>
          <figure class="scree">
            <Scree
              deviations={report.standardDeviations}
              side={side}
              kept={keptModes(report.standardDeviations, settings.value.prepare[side])}
            />
            <figcaption>SD per mode</figcaption>
          </figure>
        </div>
      )}
      {slot && !busy && <Findings side={side} report={slot.report} />}
      {slot && <Made side={side} slot={slot} />}
      {slot && !busy && <Shapes side={side} slot={slot} />}
      {report && demo.value === null && <Basis report={report} />}
      {report?.notes.map((note) => (
        <p key={note} class="note">
          {note}
        </p>
      ))}
    </section>
  );
}

function CancelButton({ side }: { side: Side }) {
  return (
    <button type="button" class="open" onClick={() => cancelOpening(side)}>
      Cancel<span class="unseen"> opening model {side.toUpperCase()}</span>
    </button>
  );
}

/** Chooses one of the models in a file; identity and expression of one file can be compared with one click. */
function Parts({ side, slot, name }: { side: Side; slot: Slot; name: string }) {
  const { parts, part, source } = slot;
  const both = parts.includes("shape") && parts.includes("expression");
  const others = slots[otherSide(side)].value;
  const shown =
    others?.source === source && [part, others.part].sort().join() === "expression,shape";
  return (
    <div class="card-row">
      <Select
        class="parts"
        label={`Part of ${name}`}
        value={part}
        options={parts.map((one) => [one, one === "shape" ? "shape (identity)" : partName(one)])}
        onChoose={(one) => void choosePart(side, one)}
      />
      {both && !shown && (
        <button
          type="button"
          class="as-link"
          onClick={() => void openParts(source, "shape", "expression")}
        >
          Compare identity with expression
        </button>
      )}
    </div>
  );
}

/** How a model was computed from shapes, and the settings of that: scaling and number of modes. */
function Made({ side, slot }: { side: Side; slot: Slot }) {
  const { origin, report } = slot;
  const { modes, variance } = settings.value.prepare[side];
  const sentence = originSentence(origin);
  return (
    <>
      {sentence && <p class="made">{sentence}</p>}
      {origin.kind === "shapes" && (
        <Check
          checked={hasWord(slot.reading, "scale")}
          onChange={(scale) => void chooseScale(side, scale)}
        >
          Also scale to one size
        </Check>
      )}
      {isSet(slot) && (
        <button
          type="button"
          class="as-link"
          disabled={readingSpecimens.value !== null}
          onClick={() => void showSpecimens(side)}
        >
          {readingSpecimens.value === side ? "Reading the specimens…" : "Specimens and groups…"}
          <span class="unseen"> of model {side.toUpperCase()}</span>
        </button>
      )}
      {(sentence || modes !== null || variance !== null) && (
        <ModesKept side={side} deviations={report.standardDeviations} />
      )}
    </>
  );
}

/** The training or test shapes of a model: how many there are, and how to give or take them back. */
function Shapes({ side, slot }: { side: Side; slot: Slot }) {
  const letter = side.toUpperCase();
  const { shapes: known, kind } = slot.report;
  const give = (files: DroppedFile[]) => {
    if (files.length > 0) void addShapes(side, filesSource(nameOfShapes(files), files));
  };
  const why = `Meshes or landmarks with the points of ${letter}. With them the page says how far shapes that ${letter} has not seen lie from it, and whether the difference is more than chance.`;
  return (
    <>
      {known && <p class="made">{shapesSentence(known)}</p>}
      {slot.shapes && (
        <button type="button" class="as-link" onClick={() => void removeShapes(side)}>
          Take back the shapes of {letter}
        </button>
      )}
      {!known && kind === "shape" && slot.source.kind !== "demo" && (
        <div class="card-row" title={why}>
          <FileButton className="as-link" label={`Shapes of model ${letter}`} onFiles={give}>
            Add its shapes…<span class="unseen"> for {letter}</span>
          </FileButton>
          <FileButton
            className="as-link"
            label={`Folder of shapes of model ${letter}`}
            folder
            onFiles={give}
          >
            Add their folder…<span class="unseen"> for {letter}</span>
          </FileButton>
        </div>
      )}
    </>
  );
}

/** Notes on what a file does not state or states wrongly: unit, orthonormal basis. */
function Basis({ report }: { report: ModelReport }) {
  const sentences = [unitSentence(report), basisSentence(report)].filter(Boolean);
  return sentences.length === 0 ? null : <p class="note">{sentences.join(" ")}</p>;
}

function Fact({ term, value }: { term: string; value: string }) {
  return (
    <div>
      <dt>{term}</dt>
      <dd>{value}</dd>
    </div>
  );
}

/** Picture of the mean shape, drawn by the viewer of the page and copied here. */
function Picture({ side }: { side: Side }) {
  const target = useRef<HTMLCanvasElement>(null);
  const key = `${drawable.value} ${isDark()}`;
  const mean = geometry.value[side];
  useEffect(() => {
    const canvas = target.current;
    const picture = cardPicture(side, PICTURE_PX);
    if (!canvas) return;
    if (!picture) {
      canvas.width = 0; // Clears the picture of another model.
      return;
    }
    canvas.width = picture.width;
    canvas.height = picture.height;
    canvas.getContext("2d")?.drawImage(picture, 0, 0);
  }, [mean, key, side]);
  return (
    <canvas
      ref={target}
      class="picture"
      role="img"
      aria-label={`Mean shape of model ${side.toUpperCase()}`}
    />
  );
}
