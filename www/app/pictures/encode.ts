/**
 * Encodes animations: WebM recorded by the browser from a canvas in real time; GIF by gifenc (Matt DesLauriers, MIT),
 * frame by frame. Both pause between frames and can be cancelled.
 */
import { applyPalette, GIFEncoder, quantize } from "gifenc";
import { type FilmOptions, FRAMES_PER_SECOND, frameCount } from "./film";
import { framesOf, type Reel } from "./reel";

type OnProgress = (share: number) => void;

const GIF_COLOURS = 256;
const FRAME_MS = 1000 / FRAMES_PER_SECOND;
const WEBM = "video/webm";
/** Bits per pixel and second of WebM. */
const BITS = 12;

export function canRecord(): boolean {
  return (
    typeof MediaRecorder === "function" &&
    MediaRecorder.isTypeSupported(WEBM) &&
    "captureStream" in HTMLCanvasElement.prototype
  );
}

export async function encodeGif(
  signal: AbortSignal,
  reel: Reel,
  options: FilmOptions,
  onProgress: OnProgress,
): Promise<Blob> {
  const frames = frameCount(options);
  const draw = framesOf(reel, options);
  const encoder = GIFEncoder();
  // One palette for all frames, from the first, middle and last one: colours do not flicker.
  const palette = quantize(
    together([0, frames >> 2, frames >> 1].map((i) => draw(i).data)),
    GIF_COLOURS,
  );
  for (let i = 0; i < frames; i += 1) {
    encoder.writeFrame(applyPalette(draw(i).data, palette), reel.width, reel.height, {
      delay: FRAME_MS,
      ...(i === 0 ? { palette, repeat: options.loops ? 0 : -1 } : {}),
    });
    onProgress((i + 1) / frames);
    await pause(0);
    signal.throwIfAborted();
  }
  encoder.finish();
  return new Blob([encoder.bytes()], { type: "image/gif" });
}

function together(found: Uint8ClampedArray[]): Uint8ClampedArray {
  const all = new Uint8ClampedArray(found.reduce((sum, { length }) => sum + length, 0));
  let place = 0;
  for (const data of found) {
    all.set(data, place);
    place += data.length;
  }
  return all;
}

/** Records in real time: a slow computer drops frames, the duration stays. */
export async function recordWebm(
  signal: AbortSignal,
  reel: Reel,
  options: FilmOptions,
  onProgress: OnProgress,
): Promise<Blob> {
  const canvas = document.createElement("canvas");
  canvas.width = reel.width;
  canvas.height = reel.height;
  const pen = canvas.getContext("2d");
  if (!pen) throw new Error("This browser has no canvas to record from.");
  const stream = canvas.captureStream(0);
  const [track] = stream.getVideoTracks() as CanvasCaptureMediaStreamTrack[];
  const recorder = new MediaRecorder(stream, {
    mimeType: WEBM,
    videoBitsPerSecond: BITS * reel.width * reel.height,
  });
  const parts: Blob[] = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  const stopped = new Promise<void>((resolve, reject) => {
    recorder.onstop = () => resolve();
    recorder.onerror = () => reject(new Error("The browser could not record the animation."));
  });
  const show = (moment: number) => {
    reel.draw(pen, moment);
    track?.requestFrame();
  };
  recorder.start();
  try {
    const length = 1000 * options.seconds;
    const begun = performance.now();
    for (let now = 0; now < length; now = performance.now() - begun) {
      show(now / length);
      onProgress(now / length);
      const spent = performance.now() - begun - now;
      await pause(Math.max(0, FRAME_MS - spent));
      signal.throwIfAborted();
    }
    show(1);
    await pause(FRAME_MS);
  } finally {
    if (recorder.state !== "inactive") recorder.stop();
    for (const one of stream.getTracks()) one.stop();
  }
  await stopped;
  return new Blob(parts, { type: WEBM });
}

function pause(milliseconds: number): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, milliseconds));
}
