/**
 * Moves values automatically (a point, the view) until the visitor stops or drags them. While they move they are not
 * in the link; when they are stopped they are.
 */
import { type ReadonlySignal, useSignal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { still, useFrames } from "./clock";
import { bounded } from "./params";

type List = readonly number[];

interface AutoplayOptions {
  /** Values of the link. */
  chosen: List;
  /** Default values, which a link leaves out: with these it moves. */
  standard: List;
  /** Values some seconds after `start`. */
  path: (start: List, seconds: number) => number[];
  write: (values: number[]) => void;
  /** Bounds and digits of the values in a link. */
  limits: { least: number; most: number; digits: number };
}

export interface Autoplay {
  now: List;
  playing: ReadonlySignal<boolean>;
  toggle: () => void;
  /** Sets the values and stops the motion. */
  hold: (values: List) => void;
}

export function useAutoplay({ chosen, standard, path, write, limits }: AutoplayOptions): Autoplay {
  const moves = (values: List) => !still.peek() && values.join() === standard.join();
  const playing = useSignal(moves(chosen));
  const now = useSignal(chosen);
  const from = useRef({ start: chosen, seconds: 0 });
  const known = useRef(chosen.join());
  const text = chosen.join();
  const take = (values: List) => {
    now.value = values;
    from.current = { start: values, seconds: 0 };
  };
  // In a layout effect: a drag right after a step of Back starts from the new values.
  useLayoutEffect(() => {
    if (text === known.current) return;
    // A link or a step of Back changed the values.
    known.current = text;
    take(chosen);
    playing.value = moves(chosen);
  });
  useFrames(playing, (elapsed) => {
    const { current } = from;
    current.seconds += elapsed / 1000;
    now.value = path(current.start, current.seconds);
  });
  const hold = (values: List) => {
    const exact = values.map((value) => bounded(limits, value));
    playing.value = false;
    known.current = exact.join();
    take(exact);
    write(exact);
  };
  return {
    now: now.value,
    playing,
    hold,
    toggle: () => {
      if (playing.peek()) hold(now.peek());
      else {
        take(now.peek());
        playing.value = true;
      }
    },
  };
}

/** Step by which an arrow key moves a point; null for other keys. */
export function nudge({ key, shiftKey }: KeyboardEvent): [number, number] | null {
  const far = shiftKey ? 0.5 : 0.1;
  switch (key) {
    case "ArrowRight":
      return [far, 0];
    case "ArrowLeft":
      return [-far, 0];
    case "ArrowUp":
      return [0, far];
    case "ArrowDown":
      return [0, -far];
    default:
      return null;
  }
}
