/** Hook for a scene whose run is animated, unless its link has a number of draws: then it is computed at once. */
import type { ReadonlySignal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { still } from "../clock";
import type { Ask } from "../engine";
import { useSceneKeys } from "../keys";
import { useOwn, useSession } from "./session";

interface Run {
  readonly playing: ReadonlySignal<boolean>;
  pause(): Promise<number>;
  run(over: (found: number) => void): void;
}

interface Growing {
  /** Key of the model and the settings; a change starts a new run. */
  of: string;
  /** Number of draws or steps, and its default. */
  far: number;
  standard: number;
  open: (ask: Ask, growing: boolean) => Promise<void>;
  /** Writes the number of draws or steps to the link. */
  write: (found: number) => void;
}

/** `again`: the next run is animated, too. */
export function useGrowing(run: Run, growing: Growing): { again: () => void; toggle: () => void } {
  const { of, far, standard, open } = growing;
  const { revision, own } = useOwn(far);
  const grows = useRef(far === standard);
  useSession(`${of} ${revision}`, async (ask) => {
    const grown = grows.current && !still.peek();
    grows.current = false;
    await open(ask, grown);
  });
  const write = (found: number) => {
    if (found === 0) return;
    own(found);
    growing.write(found);
  };
  const toggle = () => {
    if (run.playing.peek()) void run.pause().then(write);
    else run.run(write);
  };
  useSceneKeys(toggle, null);
  return {
    toggle,
    again: () => {
      grows.current = true;
    },
  };
}
