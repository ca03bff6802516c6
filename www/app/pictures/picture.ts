/** Draws the panes of the page as one picture, with labels, colour bar and caption. */

import { VENN_BOX, vennOf } from "../comparison/venn";
import { headline, settingsSentence } from "../comparison/words";
import { contrastSentence } from "../stage/contrast";
import { shownMap } from "../stage/maps";
import { differencePicture, REGION_NAMES } from "../stage/names";
import { pairsSentence } from "../stage/pairs";
import { layoutOf, viewer } from "../stage/stage-controller";
import { region, result, view } from "../state/state";
import { isDark } from "../state/theme";
import { isColoured } from "../state/view";
import { plain } from "../text/phrase";
import { saveBlob } from "../ui/download";
import { barOf } from "./figure";
import { wrapped } from "./layout";
import { drawBar, FONT, INK } from "./lettering";

const SCALE = 2;
/** Heights below the shapes: of the colour bar, of a line of text, of what is left below the last one. */
const FOOT = { bar: 48, line: 17, below: 12 };
/** Distance of the texts from the sides. */
const MARGIN = 12;

/** A line below the shapes. */
interface Line {
  text: string;
  font: string;
}

/** Background and lettering: white on the light theme, transparent with light letters on the dark one. */
export async function savePicture(): Promise<void> {
  const canvas = document.querySelector<HTMLCanvasElement>("canvas.shapes");
  const made = viewer.peek();
  if (!canvas || !made) return;
  const [width, height, panes] = layoutOf(canvas);
  const picture = document.createElement("canvas");
  const pen = picture.getContext("2d");
  if (!pen) return;
  const lines = footLines(pen, width);
  const bar = isColoured(view.peek()) ? FOOT.bar : 0;
  const foot = bar + FOOT.line * lines.length + FOOT.below;
  // A canvas forgets its font with its size.
  picture.width = width * SCALE;
  picture.height = (height + foot) * SCALE;
  pen.scale(SCALE, SCALE);
  const dark = isDark();
  if (!dark) {
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, width, height + foot);
  }
  pen.drawImage(made.capture(SCALE), 0, 0, width, height);
  pen.fillStyle = INK[dark ? "dark" : "light"];
  pen.font = `600 14px ${FONT}`;
  for (const [name, rect] of panes) {
    if (region.peek() === null || region.peek() === name) {
      pen.fillText(REGION_NAMES[name].sign, rect.x + 10, rect.y + 20);
    }
  }
  if (region.peek() === null) drawMap(pen, canvas, dark);
  drawFoot(pen, width, height, lines);
  const blob = await new Promise<Blob | null>((resolve) => picture.toBlob(resolve));
  if (blob) saveBlob(`shapevenn-${view.peek()}.png`, blob);
}

const HUES = {
  light: { a: "#2f6fd0", b: "#dd7a17", ab: "#9a4aa3" },
  dark: { a: "#7aaaff", b: "#ffab5c", ab: "#dc92e6" },
} as const;

/** Draws the Venn diagram at its position on the page. */
function drawMap(pen: CanvasRenderingContext2D, canvas: HTMLCanvasElement, dark: boolean): void {
  const report = result.peek()?.report;
  const box = document.querySelector(".venn svg")?.getBoundingClientRect();
  if (!report || !box) return;
  const whole = canvas.getBoundingClientRect();
  const { a, b, paths } = vennOf(report);
  const hue = HUES[dark ? "dark" : "light"];
  pen.save();
  pen.translate(box.x - whole.x, box.y - whole.y);
  pen.scale(box.width / VENN_BOX.width, box.width / VENN_BOX.width);
  pen.lineWidth = 1.75;
  for (const [path, colour] of [
    [paths.aWithoutB, hue.a],
    [paths.bWithoutA, hue.b],
    [paths.intersection, hue.ab],
  ] as const) {
    pen.globalAlpha = 0.3;
    pen.fillStyle = colour;
    pen.fill(new Path2D(path));
  }
  pen.globalAlpha = 1;
  for (const [circle, path, colour, letter] of [
    [a, paths.a, hue.a, "A"],
    [b, paths.b, hue.b, "B"],
  ] as const) {
    pen.strokeStyle = pen.fillStyle = colour;
    pen.stroke(new Path2D(path));
    pen.textAlign = letter === "A" ? "right" : "left";
    const side = letter === "A" ? -circle.r * 0.75 : circle.r * 0.75;
    pen.fillText(letter, circle.x + side, circle.y - circle.r * 0.75);
  }
  pen.restore();
}

/** Headline, what the view Contrast or Pairs shows, and settings, in lines that fit. */
function footLines(pen: CanvasRenderingContext2D, width: number): Line[] {
  const held = result.peek();
  if (!held) return [];
  const pushed = { contrast: contrastSentence, pairs: pairsSentence }[String(view.peek())];
  const drawn = pushed ? "" : differencePicture();
  const note = drawn === "" ? "" : ` · differences: ${drawn}`;
  const small = `11px ${FONT}`;
  return [
    { text: plain(headline(held.report, held.nouns)), font: `500 13px ${FONT}` },
    { text: pushed?.peek() ?? "", font: small },
    { text: `${settingsSentence(held.report)}${note} · Shapevenn`, font: small },
  ].flatMap(({ text, font }) => {
    pen.font = font;
    const fits = wrapped(text, width - 2 * MARGIN, (part) => pen.measureText(part).width);
    return fits.map((line) => ({ text: line, font }));
  });
}

function drawFoot(
  pen: CanvasRenderingContext2D,
  width: number,
  top: number,
  lines: readonly Line[],
): void {
  const coloured = isColoured(view.peek());
  const bar = coloured ? barOf(shownMap.peek()) : null;
  const first = top + (coloured ? FOOT.bar : 0);
  lines.forEach(({ text, font }, i) => {
    pen.font = font;
    pen.fillText(text, MARGIN, first + FOOT.line * (i + 1));
  });
  if (bar) drawBar(pen, bar, { left: MARGIN, top: top + 6, width: width - 2 * MARGIN, em: 12 });
}
