import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { MAP_WORDS } from "../stage/map-words";
import { chosenMap, contrastMap, mapIsWanted } from "../stage/maps";
import { pairings } from "../stage/pairs";
import { scene } from "../stage/stage-controller";
import { latest } from "../state/latest";
import { result, shapes, vertexMap } from "../state/state";
import { Check } from "../ui/Check";
import { copyText } from "../ui/download";
import { Modal } from "../ui/Modal";
import { NumberField } from "../ui/NumberField";
import { Segments } from "../ui/Segments";
import { Select } from "../ui/Select";
import type { FigureKind } from "./caption";
import {
  type Background,
  captionFor,
  drawFigure,
  FIRST_OPTIONS,
  type FigureOptions,
  figureOptions,
  saveFigure,
} from "./figure";
import { LARGEST_PX, SMALLEST_PX, widthInPixels } from "./layout";
import { closeOffscreen } from "./offscreen";

const BACKGROUNDS: [Background, string][] = [
  ["white", "White"],
  ["transparent", "Transparent"],
  ["dark", "Transparent, light lettering"],
];
const UNITS: [FigureOptions["unit"], string][] = [
  ["mm", "mm"],
  ["px", "pixels"],
];
const COUNTS = [4, 9, 16, 25];
/** The kinds with a colour bar. */
const COLOURED: FigureKind[] = ["contrast", "pairs", "variance", "map"];

function set(part: Partial<FigureOptions>): void {
  figureOptions.value = { ...figureOptions.value, ...part };
}

/** Dialog that saves the paper's figures as PNG, at any size. */
export function FigureDialog({ onClose }: { onClose: () => void }) {
  const options = figureOptions.value;
  const across = widthInPixels(options);
  const fits = across >= SMALLEST_PX && across <= LARGEST_PX;
  const saving = useSignal(false);
  const copied = useSignal("");
  useEffect(() => {
    mapIsWanted.value = options.shows === "map";
    return () => {
      mapIsWanted.value = false;
    };
  }, [options.shows]);
  useEffect(() => closeOffscreen, []);
  const kinds: [FigureKind, string][] = [
    ["contrast", "Contrast"],
    ...(pairings.value ? ([["pairs", "Pairs"]] as const) : []),
    ["shapes", "Random shapes"],
    ["variance", "Variance"],
    ...(vertexMap.value === "sd" ? [] : ([["map", MAP_WORDS[vertexMap.value].label]] as const)),
    ["means", "Means"],
  ].map(([kind, label]) => [kind as FigureKind, label ?? ""]);
  const save = async () => {
    saving.value = true;
    await saveFigure(options);
    saving.value = false;
  };
  return (
    <Modal title="Figure of the five regions" onClose={onClose}>
      <Segments
        legend="What the figure shows"
        name="figure-shows"
        value={kinds.some(([kind]) => kind === options.shows) ? options.shows : "variance"}
        options={kinds}
        onChoose={(shows) => set({ shows })}
      />
      <Preview options={options} />
      <div class="modal-fields">
        <Size options={options} />
        {options.shows === "shapes" && <Count value={options.shapes} />}
        <label class="number-field">
          <span>Background</span>
          <Select
            value={options.background}
            options={BACKGROUNDS}
            onChoose={(background) => set({ background })}
          />
        </label>
        <NumberField
          label="Lettering, pt"
          value={options.points}
          least={4}
          most={24}
          onChange={(points) => points !== null && set({ points })}
        />
        <Part label="Labels" part="labels" />
        {COLOURED.includes(options.shows) && <Part label="Colour bar" part="bar" />}
        <Part label="Caption" part="caption" />
      </div>
      <div class="modal-foot">
        <span class="small grow" role="status">
          {fits
            ? `${across} pixels wide, with the camera and colours of the page`
            : `A figure is ${SMALLEST_PX} to ${LARGEST_PX} pixels wide; this would be ${across}.`}
        </span>
        <button
          type="button"
          class="quiet"
          onClick={() =>
            void copyText(captionFor(options)).then((done) => {
              copied.value = done ? "Caption copied" : "Copying is not allowed here";
            })
          }
        >
          {copied.value || "Copy caption"}
        </button>
        <button
          type="button"
          class="primary"
          disabled={!fits || saving.value || !result.value}
          onClick={() => void save()}
        >
          {saving.value ? "Drawing…" : "Save PNG"}
        </button>
      </div>
    </Modal>
  );
}

function Size({ options }: { options: FigureOptions }) {
  const { unit, width, dpi } = options;
  const most = unit === "px" ? LARGEST_PX : Math.floor((25.4 * LARGEST_PX) / dpi);
  return (
    <>
      <NumberField
        label="Width"
        value={width}
        least={1}
        most={Math.max(1, most)}
        onChange={(value) => value !== null && set({ width: value })}
      />
      <Select
        label="Unit of the width"
        value={unit}
        options={UNITS}
        onChoose={(chosen) => {
          // Converts the width to the other unit, rounded to whole numbers.
          const across = widthInPixels(options);
          const millimetres = Math.max(1, Math.round((25.4 * across) / dpi));
          set({ unit: chosen, width: chosen === "px" ? across : millimetres });
        }}
      />
      <NumberField
        label="Resolution, dpi"
        value={dpi}
        least={36}
        most={2400}
        onChange={(value) => value !== null && set({ dpi: value })}
      />
    </>
  );
}

function Count({ value }: { value: number }) {
  const flat = scene.value.geometry.a?.segments !== null && scene.value.geometry.a !== null;
  // Outlines are overlaid, as many as the page shows.
  if (flat) return null;
  return (
    <label class="number-field">
      <span>Shapes in a block</span>
      <Select
        value={String(value)}
        options={COUNTS.map((count) => [String(count), String(count)])}
        onChoose={(count) => set({ shapes: Number(count) })}
      />
    </label>
  );
}

function Part({ label, part }: { label: string; part: "labels" | "bar" | "caption" }) {
  return (
    <Check checked={figureOptions.value[part]} onChange={(checked) => set({ [part]: checked })}>
      {label}
    </Check>
  );
}

const PREVIEW_PX = 680;

/** Preview of the figure as it will be saved. */
function Preview({ options }: { options: FigureOptions }) {
  const place = useRef<HTMLDivElement>(null);
  const problem = useSignal("");
  const draw = useRef(
    latest(async (wanted: FigureOptions) => {
      try {
        const across = Math.round(PREVIEW_PX * Math.min(devicePixelRatio, 2));
        const canvas = await drawFigure(wanted, across);
        problem.value = canvas ? "" : "There are no shapes to draw yet.";
        if (canvas) place.current?.replaceChildren(canvas);
      } catch (thrown) {
        problem.value = thrown instanceof Error ? thrown.message : String(thrown);
      }
    }),
  );
  const [map, contrast, drawn] = [chosenMap.value, contrastMap.value, shapes.value];
  // Drawn again also when the shapes change.
  useEffect(() => draw.current(options), [options, map, contrast, drawn]);
  return (
    <div
      class="figure-preview"
      data-background={options.background}
      role="img"
      aria-label={`Preview of the figure: ${captionFor(options)}`}
    >
      <div ref={place} />
      {problem.value && <p class="small">{problem.value}</p>}
    </div>
  );
}

/** Saves a figure with its default options, for the buttons among the downloads. */
export async function saveAsOffered(shows: FigureKind): Promise<void> {
  await saveFigure({ ...FIRST_OPTIONS, shows });
  closeOffscreen();
}
