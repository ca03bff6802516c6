import { useComputed } from "@preact/signals";
import type { Region } from "../../worker/protocol";
import { VENN_BOX, vennOf } from "../comparison/venn";
import { outOfDate, painting, region, result } from "../state/state";
import { length, percent } from "../text/format";
import { regionLabel } from "./names";

/**
 * Venn diagram of the total variances to scale; a click on a region shows it alone. Where the means lie is not in it, so
 * that models far apart may overlap: the caption says how far.
 */
export function VennMap() {
  const report = result.value?.report;
  const venn = useComputed(() => result.value && vennOf(result.value.report)).value;
  if (!venn || !report || painting.value) return <figure class="venn" aria-hidden="true" />;
  const { a, b, paths } = venn;
  const { varianceOfAInB, varianceOfBInA, meanToMean: apart } = report.overlap;
  const middle = (Math.max(a.x - a.r, b.x - b.r) + Math.min(a.x + a.r, b.x + b.r)) / 2;
  const labelA = (a.x - a.r + Math.max(a.x - a.r, Math.min(b.x - b.r, a.x + a.r))) / 2;
  const labelB = (b.x + b.r + Math.min(b.x + b.r, Math.max(a.x + a.r, b.x - b.r))) / 2;
  return (
    <figure class="venn" data-stale={outOfDate.value}>
      {/* biome-ignore lint/a11y/useSemanticElements: a drawing is no fieldset */}
      <svg
        viewBox={`0 0 ${VENN_BOX.width} ${VENN_BOX.height}`}
        role="group"
        aria-label={describe(varianceOfAInB, varianceOfBInA)}
      >
        <Area name="aWithoutB" path={paths.aWithoutB} />
        <Area name="bWithoutA" path={paths.bWithoutA} />
        <Area name="intersection" path={paths.intersection} />
        <path class="rim rim-a" d={paths.a} />
        <path class="rim rim-b" d={paths.b} />
        <Letter name="a" x={labelA} y={a.y} text="A" />
        <Letter name="b" x={labelB} y={b.y} text="B" />
        <text class="venn-share" x={middle} y={a.y + 5}>
          A∩B
        </text>
      </svg>
      <figcaption>
        Areas: how much A and B vary about their own means
        {apart > 0 ? `, which are ${length(apart, report.models.a.unit)} apart` : ""}. Choose a
        region to show it alone.
      </figcaption>
    </figure>
  );
}

function describe(aInB: number, bInA: number): string {
  return `Venn diagram to scale: B can make ${percent(aInB)} of A’s variance, A ${percent(bInA)} of B’s`;
}

function go(name: Region): void {
  region.value = region.value === name ? null : name;
}

/** Attributes of a part of the drawing that is a button for a region: there are no buttons in SVG. */
function buttonFor(name: Region) {
  return {
    "data-area": name,
    role: "button" as const,
    tabindex: 0,
    "aria-pressed": region.value === name,
    "aria-label": regionLabel(name),
    onClick: () => go(name),
    onKeyDown: (event: KeyboardEvent) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      go(name);
    },
  };
}

function Area({ name, path }: { name: Region; path: string }) {
  if (path === "") return null;
  return (
    <path class="area" d={path} {...buttonFor(name)}>
      <title>{regionLabel(name)}</title>
    </path>
  );
}

/** The letter of a circle, a button for the whole model. */
function Letter({ name, x, y, text }: { name: "a" | "b"; x: number; y: number; text: string }) {
  return (
    <g class="letter-button" {...buttonFor(name)}>
      <title>{regionLabel(name)}</title>
      <circle class="reach" cx={x} cy={y} r={22} />
      <circle class="disc" cx={x} cy={y} r={13} />
      <text x={x} y={y + 5}>
        {text}
      </text>
    </g>
  );
}
