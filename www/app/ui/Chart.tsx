import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";
import { ShowNumbers } from "./ShowNumbers";

/** Advice under a plot: whether it is fine, and what to do if not. */
export interface Advice {
  /** Whether no action is needed. */
  calm: boolean;
  text: string;
  /** The chain that it names, from 0. */
  chain: number | null;
}

export interface ChartProps {
  title: string;
  /** Explanation of the plot in a sentence. */
  about: ComponentChildren;
  /** The main numbers in words, for screen readers. */
  label: string;
  /** Height in pixels for a given width. */
  height: (width: number) => number;
  draw: (width: number) => ComponentChildren;
  /** Laid over the plot, as a handle. */
  over?: ComponentChildren;
  legend?: ComponentChildren;
  advice?: Advice | null;
  table?: () => ComponentChildren;
  children?: ComponentChildren;
  name: string;
}

/** A plot with title, explanation, advice, and a table of its numbers. */
export function Chart(props: ChartProps) {
  const { title, about, label, height, draw, over, legend, advice, table, children, name } = props;
  const box = useRef<HTMLDivElement>(null);
  const width = useSignal(0);
  // Drawn at its size in pixels, so that letters have the same size in every plot.
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
        {wide > 0 && over}
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
