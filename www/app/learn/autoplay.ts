/**
 * What moves by itself until it is touched: a point, a camera. While it moves it is nobody’s choice and
 * not in the link; where it is stopped, it is.
 */
import { type ReadonlySignal, useSignal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { still, useFrames } from "./clock";
import { bounded } from "./params";

type List = readonly number[];

interface AutoplayOptions {
  /** As in the link. */
  chosen: List;
  /** What a link leaves out: then it moves. */
  standard: List;
  /** Where it is some seconds after it was at `start`. */
  path: (start: List, seconds: number) => number[];
  write: (values: number[]) => void;
  /** Bounds and digits of the link. */
  limits: { least: number; most: number; digits: number };
}

export interface Autoplay {
  now: List;
  playing: ReadonlySignal<boolean>;
  toggle: () => void;
  /** Takes it there, and stops it. */
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
  // At once: whoever takes hold of something right after a step of Back holds what is there then.
  useLayoutEffect(() => {
    if (text === known.current) return;
    // A link, a step of Back.
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

/** How far the arrow keys move a point; null for other keys. */
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
