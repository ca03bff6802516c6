import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";
import { ShowNumbers } from "./ShowNumbers";

/** What to do about what a plot shows. */
export interface Advice {
  /** Whether there is nothing to do. */
  calm: boolean;
  text: string;
  /** The chain that it is about, from 0. */
  chain: number | null;
}

interface Props {
  title: string;
  /** What is drawn, in a sentence. */
  about: ComponentChildren;
  /** The key numbers, for those who do not see the plot. */
  label: string;
  /** In pixels, at the width that there is. */
  height: (width: number) => number;
  draw: (width: number) => ComponentChildren;
  legend?: ComponentChildren;
  advice?: Advice | null;
  table?: () => ComponentChildren;
  children?: ComponentChildren;
  name: string;
}

/** A plot with its title, what it says, and the table behind it. */
export function Chart(props: Props) {
  const { title, about, label, height, draw, legend, advice, table, children, name } = props;
  const box = useRef<HTMLDivElement>(null);
  const width = useSignal(0);
  // Drawn at its size in pixels, so that letters are as large in every plot.
  useLayoutEffect(() => {
    const element = box.current;
    if (!element) return;
    const measure = () => {
      width.value = Math.floor(element.clientWidth);
    };
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    return () => observer.disconnect();
  }, []);
  const [wide, tall] = [width.value, width.value > 0 ? height(width.value) : 0];
  return (
    <figure class="chart" data-chart={name}>
      <figcaption>
        <h3>{title}</h3>
        <p class="small">{about}</p>
      </figcaption>
      <div class="chart-box" ref={box}>
        {wide > 0 && (
          <svg
            class="plot"
            width={wide}
            height={tall}
            viewBox={`0 0 ${wide} ${tall}`}
            role="img"
            aria-label={label}
          >
            {draw(wide)}
          </svg>
        )}
      </div>
      {legend}
      {advice && <AdviceLine advice={advice} />}
      {children}
      {table && <ShowNumbers>{table}</ShowNumbers>}
    </figure>
  );
}

export function AdviceLine({ advice }: { advice: Advice }) {
  return (
    <p class="advice" data-calm={advice.calm}>
      {advice.text}
    </p>
  );
}
