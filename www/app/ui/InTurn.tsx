import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect } from "preact/hooks";

/** Draws many parts one a frame, so that all of them together do not hold the page; later changes are drawn at once. */
export function InTurn({ parts }: { parts: ComponentChildren[] }) {
  const drawn = useSignal(1);
  const count = drawn.value;
  useEffect(() => {
    if (count >= parts.length) return;
    const frame = requestAnimationFrame(() => {
      drawn.value = count + 1;
    });
    return () => cancelAnimationFrame(frame);
  }, [count, parts.length, drawn]);
  return <>{parts.slice(0, count)}</>;
}
