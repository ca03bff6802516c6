/** A runner’s board: the target, where its chains were, where they are. */
import type { Size } from "../../canvas/Board";
import { chainColour, drawDot } from "../../canvas/chains";
import { faded, type Palette } from "../../canvas/palette";
import { drawField, planeOf } from "../../canvas/plane";
import type { View } from "./broken";
import type { Runner } from "./run";

export function drawRunner(
  pen: CanvasRenderingContext2D,
  size: Size,
  palette: Palette,
  runner: Runner,
  view: View,
  image: HTMLCanvasElement,
): void {
  const plane = planeOf(size, view.extent, view.centre);
  drawField(pen, plane, image, view.fieldExtent);
  const { trail, dimension } = runner;
  const chains = trail.length === 0 ? 0 : Math.round(runner.width / dimension);
  for (let chain = 0; chain < chains; chain += 1) {
    const column = chain * dimension;
    pen.strokeStyle = faded(chainColour(palette, chain), 0.45);
    pen.lineWidth = 1;
    pen.beginPath();
    for (let i = 0; i < trail.length; i += 1) {
      pen.lineTo(plane.x(trail.at(i, column)), plane.y(trail.at(i, column + 1)));
    }
    pen.stroke();
    pen.fillStyle = chainColour(palette, chain);
    pen.beginPath();
    for (let i = 0; i < trail.length; i += 1) {
      const [x, y] = [plane.x(trail.at(i, column)), plane.y(trail.at(i, column + 1))];
      pen.moveTo(x + 1.6, y);
      pen.arc(x, y, 1.6, 0, 2 * Math.PI);
    }
    pen.fill();
  }
  for (let chain = 0; chain < chains; chain += 1) {
    const column = chain * dimension;
    const last = trail.length - 1;
    const [x, y] = [plane.x(trail.at(last, column)), plane.y(trail.at(last, column + 1))];
    drawDot(pen, x, y, 4.5, chainColour(palette, chain), palette.raised);
  }
}
