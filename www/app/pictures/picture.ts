/** Draws the panes of the page as one picture, with labels, colour bar and caption. */

import { VENN_BOX, vennOf } from "../comparison/venn";
import { headline, settingsSentence } from "../comparison/words";
import { shownMap } from "../stage/maps";
import { differencePicture, REGION_NAMES } from "../stage/names";
import { layoutOf, viewer } from "../stage/stage-controller";
import { region, result, view } from "../state/state";
import { isDark } from "../state/theme";
import { isColoured } from "../state/view";
import { plain } from "../text/phrase";
import { saveBlob } from "../ui/download";
import { barOf } from "./figure";
import { drawBar, FONT, INK } from "./lettering";

const SCALE = 2;
/** Height of the texts below the shapes; more with a colour bar. */
const FOOT = { bar: 48, words: 48 };

/** Background and lettering: white on the light theme, transparent with light letters on the dark one. */
export async function savePicture(): Promise<void> {
  const canvas = document.querySelector<HTMLCanvasElement>("canvas.shapes");
  const made = viewer.peek();
  if (!canvas || !made) return;
  const [width, height, panes] = layoutOf(canvas);
  const foot = isColoured(view.peek()) ? FOOT.bar + FOOT.words : FOOT.words;
  const picture = document.createElement("canvas");
  picture.width = width * SCALE;
  picture.height = (height + foot) * SCALE;
  const pen = picture.getContext("2d");
  if (!pen) return;
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
  drawFoot(pen, width, height);
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

function drawFoot(pen: CanvasRenderingContext2D, width: number, top: number): void {
  const held = result.peek();
  const bar = isColoured(view.peek()) ? barOf(shownMap.peek()) : null;
  const above = isColoured(view.peek()) ? FOOT.bar : 0;
  const line = (text: string, y: number, font: string) => {
    pen.font = font;
    pen.fillText(text, 12, top + y, width - 24);
  };
  if (held) {
    line(plain(headline(held.report, held.nouns)), above + 16, `500 13px ${FONT}`);
    const drawn = differencePicture();
    const note = drawn === "" ? "" : ` · differences: ${drawn}`;
    line(`${settingsSentence(held.report)}${note} · Shapevenn`, above + 36, `11px ${FONT}`);
  }
  if (bar) drawBar(pen, bar, { left: 12, top: top + 6, width: width - 24, em: 12 });
}
