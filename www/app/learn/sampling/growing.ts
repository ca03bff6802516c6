/** A run that grows before the eye, unless a link says how far it is: then it stands there. */
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
  /** What is sampled, and how: anything else begins anew. */
  of: string;
  /** How far it goes, and how far when no link says so. */
  far: number;
  standard: number;
  open: (ask: Ask, growing: boolean) => Promise<void>;
  /** Puts how far it came into the link. */
  write: (found: number) => void;
}

/** `again`: what is chosen next is shown growing too. */
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
