/** Requests the shapes of an animation and draws its frames. */

import type { Region, Space } from "../../worker/protocol";
import { scene } from "../stage/stage-controller";
import { engineClient } from "../state/engine";
import { camera } from "../state/state";
import { contentOf, type Scene } from "../viewer/contents";
import { type Frame, frameOf, type PaneContent, type Viewer } from "../viewer/viewer";
import {
  blend,
  type FilmOptions,
  type Keyframe,
  labelAt,
  momentOf,
  positionAt,
  REACH_SD,
} from "./film";
import { FONT, INK } from "./lettering";
import { offscreenViewer } from "./offscreen";

/** An animation that can be drawn at any moment. */
export interface Reel {
  width: number;
  height: number;
  /** Draws a moment on a canvas of its size. */
  draw(pen: CanvasRenderingContext2D, moment: number): void;
}

/** Width in pixels for which lettering and lines are designed. */
const DESIGNED_FOR = 480;
const LABEL = { top: 22, labelHeight: 30, size: 14 };

export async function reelOf(signal: AbortSignal, options: FilmOptions): Promise<Reel> {
  const found: Scene = {
    ...scene.peek(),
    mode: "mean",
    dark: options.background === "dark",
    map: undefined,
    ellipsoids: {},
  };
  const [content, keys] = await keyframesOf(signal, options, found);
  const { fade } = content;
  const dimension = found.geometry.a?.dimension ?? 3;
  const frame = frameOf(
    keys.map(({ shape }) => shape),
    dimension,
    fade,
  );
  const aspect = Math.min(3, Math.max(1 / 3, frame.halfWidth / frame.halfHeight));
  const scale = options.size / DESIGNED_FOR;
  const labelHeight = options.label ? LABEL.labelHeight : 0;
  // Codecs need even sizes.
  const even = (value: number) => 2 * Math.round(value / 2);
  const [width, height] = [even(options.size), even(options.size / aspect + labelHeight * scale)];
  const viewer = await offscreenViewer();
  const reel = { viewer, width, height, scale, labelHeight, frame, content, keys, options };
  return { width, height, draw: (pen, moment) => drawMoment(pen, reel, moment) };
}

interface Drawn {
  viewer: Viewer;
  width: number;
  height: number;
  scale: number;
  labelHeight: number;
  frame: Frame;
  content: PaneContent;
  keys: Keyframe[];
  options: FilmOptions;
}

function drawMoment(pen: CanvasRenderingContext2D, reel: Drawn, moment: number): void {
  const { width, height, scale, labelHeight, content, options } = reel;
  const dark = options.background === "dark";
  const position = positionAt(options, moment);
  const mixed = blend(reel.keys, position);
  if (!mixed) return;
  pen.fillStyle = dark ? "#131519" : "#fff";
  pen.fillRect(0, 0, width, height);
  const [w, h] = [width / scale, height / scale];
  const shot = reel.viewer.capture(scale, {
    width: w,
    height: h,
    layout: new Map([
      [content.region, { x: 0, y: labelHeight, width: w, height: h - labelHeight }],
    ]),
    panes: [{ ...content, shapes: [mixed.shape], tint: mixed.tint }],
    frame: reel.frame,
    camera: camera.peek(),
    range: null,
  });
  pen.drawImage(shot, 0, 0);
  if (!options.label) return;
  pen.fillStyle = INK[dark ? "dark" : "light"];
  pen.font = `600 ${LABEL.size * scale}px ${FONT}`;
  pen.textAlign = "center";
  pen.fillText(labelAt(options, position), width / 2, LABEL.top * scale);
}

/** The surface and the keyframes of an animation. */
async function keyframesOf(
  signal: AbortSignal,
  options: FilmOptions,
  found: Scene,
): Promise<[PaneContent, Keyframe[]]> {
  const { subject, mode } = options;
  const shape = async (space: Space, coefficients: number[]) =>
    (await engineClient().explore(signal, space, "modes", coefficients, false)).shape;
  const contentIn = (region: Region) => {
    const content = contentOf(found, region);
    if (!content) throw new Error("There are no shapes to draw yet.");
    return content;
  };
  if (subject !== "morph") {
    const content = contentIn(subject);
    const keys: Keyframe[] = [];
    for (const at of [-REACH_SD, REACH_SD]) {
      const coefficients = [...Array<number>(mode).fill(0), at];
      keys.push({ at, shape: await shape(subject, coefficients), tint: content.tint });
    }
    return [content, keys];
  }
  const keys: Keyframe[] = [];
  for (const [at, space] of (["a", "intersection", "b"] as const).entries()) {
    keys.push({ at, shape: await shape(space, []), tint: contentIn(space).tint });
  }
  return [contentIn("a"), keys];
}

/** Draws one moment of an animation on a new canvas. */
export function stillOf(reel: Reel, moment: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = reel.width;
  canvas.height = reel.height;
  const pen = canvas.getContext("2d");
  if (pen) reel.draw(pen, moment);
  return canvas;
}

/** The pixels of a frame, read from a canvas of its own. */
export function framesOf(reel: Reel, options: FilmOptions): (frame: number) => ImageData {
  const canvas = document.createElement("canvas");
  canvas.width = reel.width;
  canvas.height = reel.height;
  const pen = canvas.getContext("2d", { willReadFrequently: true });
  if (!pen) throw new Error("This browser has no canvas to draw on.");
  return (frame) => {
    reel.draw(pen, momentOf(options, frame));
    return pen.getImageData(0, 0, reel.width, reel.height);
  };
}
