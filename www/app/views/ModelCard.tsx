import { useEffect, useRef } from "preact/hooks";
import { bytes, count, length } from "../format";
import { choosePart, nameOf, openFiles } from "../models";
import { chosenPart, demo, opening, result, type Side, slots } from "../state";
import { isDark } from "../theme";
import { cardPicture, drawable } from "../viewer/stage-controller";
import { Notices } from "./Notices";
import { Scree } from "./Scree";

const PICTURE_PX = 84;

export function ModelCard({ side }: { side: Side }) {
  const slot = slots[side].value;
  // Before the engine is up, the stored report already describes both models.
  const report = chosenPart(side)?.report ?? result.value?.report.models[side];
  const ofFile = slot && slot.source.kind !== "demo" ? nameOf(slot.source) : undefined;
  const name = ofFile ?? report?.name ?? demo.value?.[side] ?? "";
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
          <h2 title={name}>{busy ?? name}</h2>
          <p class="format">{busy ? "Opening…" : (report?.format ?? "")}</p>
        </div>
        <OpenButton side={side} />
      </div>
      <Notices place={side} />
      {slot && slot.parts.length > 1 && (
        <select
          class="parts"
          aria-label={`Part of ${name}`}
          value={String(slot.chosen)}
          onChange={(event) => void choosePart(side, Number(event.currentTarget.value))}
        >
          {slot.parts.map((part, i) => (
            <option key={part.model} value={String(i)}>
              {part.part}
            </option>
          ))}
        </select>
      )}
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
            <Scree deviations={report.standardDeviations} side={side} />
            <figcaption>SD per mode</figcaption>
          </figure>
        </div>
      )}
      {report?.notes.map((note) => (
        <p key={note} class="note">
          {note}
        </p>
      ))}
    </section>
  );
}

function Fact({ term, value }: { term: string; value: string }) {
  return (
    <div>
      <dt>{term}</dt>
      <dd>{value}</dd>
    </div>
  );
}

function OpenButton({ side }: { side: Side }) {
  const input = useRef<HTMLInputElement>(null);
  // No `accept`: iOS greys out files of types it does not know.
  return (
    <>
      <button type="button" class="open" onClick={() => input.current?.click()}>
        Open model…<span class="unseen"> for {side.toUpperCase()}</span>
      </button>
      <input
        ref={input}
        class="unseen"
        type="file"
        multiple
        tabIndex={-1}
        aria-label={`File for model ${side.toUpperCase()}`}
        onChange={(event) => {
          void openFiles([...(event.currentTarget.files ?? [])], side);
          event.currentTarget.value = "";
        }}
      />
    </>
  );
}

/** Drawn by the one viewer of the page and copied here. */
function Picture({ side }: { side: Side }) {
  const target = useRef<HTMLCanvasElement>(null);
  const key = `${drawable.value} ${isDark()}`;
  const geometry = slots[side].value?.geometry;
  useEffect(() => {
    const canvas = target.current;
    const picture = cardPicture(side, PICTURE_PX);
    if (!canvas) return;
    if (!picture) {
      canvas.width = 0; // Clears what was there of another model.
      return;
    }
    canvas.width = picture.width;
    canvas.height = picture.height;
    canvas.getContext("2d")?.drawImage(picture, 0, 0);
  }, [geometry, key, side]);
  return (
    <canvas
      ref={target}
      class="picture"
      role="img"
      aria-label={`Mean shape of model ${side.toUpperCase()}`}
    />
  );
}
