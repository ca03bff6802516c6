import { useSignal } from "@preact/signals";
import { useRef } from "preact/hooks";
import type { Inspection, Remedy, Side, SidePreparation } from "../../worker/protocol";
import { alignmentWords, pairLine } from "../comparison/words";
import { beginPainting } from "../models/painting";
import { takeList } from "../models/pair";
import { pointsText, UNITS, UNSTATED } from "../state/preparation";
import { ALIGNMENTS, DEFAULTS, parseCount, SUBSAMPLE } from "../state/settings";
import { change, inspected, pairKey, SIDES, settings, spoken, unit } from "../state/state";
import { count, number } from "../text/format";
import { parseRanges } from "../text/ranges";
import { Check } from "../ui/Check";
import { Choice } from "../ui/Choice";
import { Field } from "../ui/Field";
import { CloseIcon } from "../ui/icons";
import { Notices, showNotice } from "../ui/Notices";
import { Select } from "../ui/Select";
import { TypedField } from "../ui/TypedField";

/** Card of the pair: whether the two models can be compared, and the remedies if they cannot. */
export function PairCard() {
  const found = inspected.value?.inspection;
  /** Whether the visitor opened or closed the details; null until then. */
  const opened = useSignal<boolean | null>(null);
  if (!found) return <Notices place="pair" />;
  const { problem, remedies, applied } = found;
  const open = opened.value ?? false;
  const urgent = remedies.filter(({ recommended }) => recommended || problem !== null);
  const others = remedies.filter((remedy) => !urgent.includes(remedy));
  return (
    <section
      class="pair"
      aria-label="Comparable?"
      data-stale={inspected.value?.key !== pairKey.value}
    >
      {problem && (
        <div
          key={problem.message}
          ref={showNotice}
          class="notice"
          role="alert"
          data-code={problem.code}
        >
          <div>
            <p class="notice-message">{problem.message}</p>
            <p class="notice-hint">{problem.hint}</p>
          </div>
        </div>
      )}
      <Notices place="pair" />
      {urgent.map((remedy) => (
        <Offer key={remedy.id} remedy={remedy} />
      ))}
      {applied.length > 0 && <Applied applied={applied} />}
      <details
        class="pair-more"
        open={open}
        onToggle={(event) => {
          opened.value = event.currentTarget.open;
        }}
      >
        <summary>
          <span class="pair-line">{pairLine(found, unit.value)}</span>
        </summary>
        <Facts found={found} />
        {others.map((remedy) => (
          <Offer key={remedy.id} remedy={remedy} />
        ))}
        <Controls found={found} />
      </details>
    </section>
  );
}

/** A remedy as a button, with the reason for it. */
function Offer({ remedy }: { remedy: Remedy }) {
  const { label, sentence, recommended } = remedy;
  return (
    <div class="remedy" data-remedy={remedy.id}>
      <button
        type="button"
        class={recommended ? "primary" : ""}
        onClick={() => {
          change(remedy.settings);
          spoken.value = `${label}: done. It can be undone.`;
        }}
      >
        {label}
      </button>
      <p class="small">{sentence}</p>
    </div>
  );
}

/** The remedies that were applied; each can be undone. */
function Applied({ applied }: { applied: Remedy[] }) {
  return (
    <ul class="chips" aria-label="Changes to the models">
      {applied.map((remedy) => (
        <li key={remedy.id} class="chip" data-remedy={remedy.id} title={remedy.sentence}>
          <span>{remedy.label}</span>
          <button
            type="button"
            class="quiet icon-only"
            aria-label={`Undo: ${remedy.label}`}
            onClick={() => {
              change(remedy.settings);
              spoken.value = `${remedy.label}: undone.`;
            }}
          >
            <CloseIcon />
          </button>
        </li>
      ))}
    </ul>
  );
}

function Facts({ found }: { found: Inspection }) {
  const { points, units, scale } = found;
  const of = (side: Side) => {
    const { stated, guess } = units[side];
    if (stated !== UNSTATED) return stated;
    return guess ? `probably ${guess}` : "not stated";
  };
  const apart = alignmentWords(found, unit.value);
  return (
    <dl class="pair-facts">
      <dt>points</dt>
      <dd>
        A {count(points.a)}, B {count(points.b)}
      </dd>
      <dt>unit</dt>
      <dd>
        A {of("a")}, B {of("b")}
      </dd>
      {scale !== null && (
        <>
          <dt>size</dt>
          <dd>B is {number(scale)} times as large as A</dd>
        </>
      )}
      {apart && (
        <>
          <dt>means</dt>
          <dd>{apart}</dd>
        </>
      )}
    </dl>
  );
}

function Controls({ found }: { found: Inspection }) {
  const { align, prepare } = settings.value;
  const { a, b } = found.units;
  const unlike = a.stated !== b.stated && a.stated !== UNSTATED && b.stated !== UNSTATED;
  return (
    <div class="pair-controls">
      <Choice
        label="Align B to A"
        value={align}
        options={ALIGNMENTS}
        standard={DEFAULTS.align}
        onChoose={(next) => change({ align: next })}
      />
      {SIDES.map((side) => (
        <UnitField key={side} side={side} found={found.units[side]} own={prepare[side]} />
      ))}
      {(unlike || prepare.convert) && (
        <Check checked={prepare.convert} onChange={(convert) => change({ prepare: { convert } })}>
          Convert B into the unit of A
        </Check>
      )}
      <TypedField
        label="At most"
        accessibleLabel="Most points compared"
        value={prepare.subsample === null ? "" : String(prepare.subsample)}
        standard=""
        placeholder="all"
        suffix="points"
        help="Largest number of compared points. Fewer are compared faster; they are spread evenly over the shape."
        parse={(text) => (text.trim() === "" ? null : parseCount(text, ...SUBSAMPLE))}
        onChange={(subsample) => change({ prepare: { subsample } })}
        wrong="a whole number, or nothing for all"
      />
      <Points />
    </div>
  );
}

interface UnitProps {
  side: Side;
  found: Inspection["units"]["a"];
  own: SidePreparation;
}

/** Declares the unit of a model whose file states none; a stated unit cannot be changed. */
function UnitField({ side, found, own }: UnitProps) {
  if (own.unit === null && found.stated !== UNSTATED) return null;
  const letter = side.toUpperCase();
  const declare = (unit: string | null) => change({ prepare: { [side]: { unit } } });
  return (
    <Field
      label={`Unit of ${letter}`}
      changed={own.unit !== null}
      onReset={() => declare(null)}
      standardWord=""
    >
      <Select
        label={`Unit of ${letter}`}
        value={own.unit ?? ""}
        options={[
          ["", "not stated"],
          ...UNITS.map(
            (unit) => [unit, unit === found.guess ? `${unit} (probably)` : unit] as const,
          ),
        ]}
        onChoose={(unit) => declare(unit || null)}
      />
    </Field>
  );
}

/** Chooses which points are compared: painted, typed, or from a file. */
function Points() {
  const input = useRef<HTMLInputElement>(null);
  const { points } = settings.value.prepare;
  const choose = (ranges: string | null) =>
    change({ prepare: { points: ranges === null ? null : { by: "region", ranges } } });
  return (
    <div class="points">
      <TypedField
        label="Points"
        accessibleLabel="Points that are compared"
        value={points === null ? "" : points.by === "region" ? points.ranges : pointsText(points)}
        standard=""
        placeholder="all"
        suffix={points?.by === "region" ? pointsText(points) : "as 0-99, 120"}
        parse={(text) => (text.trim() === "" ? null : parseRanges(text))}
        onChange={choose}
        wrong="vertices as 0-99, 120"
        help="Numbers of vertices, from 0; both models are compared on these alone."
      />
      <div class="card-row">
        <button type="button" onClick={beginPainting}>
          {points?.by === "region" ? "Paint on…" : "Paint a region…"}
        </button>
        <button
          type="button"
          title="A text file with one vertex a line, or with pairs: a vertex of A and one of B"
          onClick={() => input.current?.click()}
        >
          From a list…
        </button>
        <input
          ref={input}
          class="unseen"
          type="file"
          tabIndex={-1}
          aria-label="File of vertices, or of pairs of vertices of A and B"
          onChange={(event) => {
            const file = event.currentTarget.files?.[0];
            if (file) void takeList(file);
            event.currentTarget.value = "";
          }}
        />
      </div>
    </div>
  );
}
