import type { ComponentChildren } from "preact";
import type { LessonModel, Side } from "../../../../worker/protocol";
import { modeOf, pointOf } from "../../shape";
import { pathOf } from "../../star";
import { STAR_EXTENT } from "./StarCanvas";

interface Props {
  model: LessonModel;
  coefficients: readonly number[];
  shape: readonly number[];
  side: Side;
}

/** The formula of a shape as a row of small stars, with the present coefficients. */
export function Equation({ model, coefficients, shape, side }: Props) {
  const [first = 0, second = 0] = coefficients;
  return (
    <section class="equation" data-side={side} aria-label="The shape as a sum">
      <div class="equation-part">
        <Term symbol={<i>x</i>} says="shape">
          <path d={pathOf(shape)} class="equation-shape" />
        </Term>
        <span class="equation-sign">=</span>
        <Term symbol="x̄" says="mean">
          <path d={pathOf(model.mean)} class="equation-mean" />
        </Term>
      </div>
      <div class="equation-part">
        <Factor value={first} name="α₁" order="first" />
        <Term symbol={mode("₁")} says="basis: mode 1" order="first">
          <Mode model={model} mode={0} />
        </Term>
      </div>
      <div class="equation-part">
        <Factor value={second} name="α₂" order="second" />
        <Term symbol={mode("₂")} says="basis: mode 2" order="second">
          <Mode model={model} mode={1} />
        </Term>
      </div>
    </section>
  );
}

const mode = (index: string) => (
  <>
    √λ{index} <i>u</i>
    {index}
  </>
);

interface TermProps {
  symbol: ComponentChildren;
  says: string;
  order?: "first" | "second";
  children: ComponentChildren;
}

function Term({ symbol, says, order, children }: TermProps) {
  const box = `${-STAR_EXTENT} ${-STAR_EXTENT} ${2 * STAR_EXTENT} ${2 * STAR_EXTENT}`;
  return (
    <figure class="equation-term" data-order={order}>
      <svg viewBox={box} aria-hidden="true">
        {children}
      </svg>
      <figcaption>
        <b>{symbol}</b>
        <span class="small">{says}</span>
      </figcaption>
    </figure>
  );
}

function Factor({ value, name, order }: { value: number; name: string; order: string }) {
  const size = Math.abs(value).toFixed(2);
  return (
    <span class="equation-factor" data-order={order}>
      <span class="equation-sign">{value < 0 && size !== "0.00" ? "−" : "+"}</span>
      <span class="equation-number">
        <output class="num">{size}</output>
        <span class="small">{name}, coefficient</span>
      </span>
      <span class="equation-sign">·</span>
    </span>
  );
}

/** A mode as arrows at the points of the mean: it is a displacement, not a shape. */
function Mode({ model, mode }: { model: LessonModel; mode: number }) {
  const way = modeOf(model, mode);
  const points = Array.from({ length: model.mean.length / 2 }, (_, i) => i);
  return (
    <>
      <path d={pathOf(model.mean)} class="equation-mean" />
      {points.map((point) => {
        const [x, y] = pointOf(model.mean, point);
        const [dx, dy] = pointOf(way, point);
        const length = Math.hypot(dx, dy);
        if (length < 0.2) return null;
        const [u, v] = [dx / length, dy / length];
        const [tipX, tipY] = [x + dx, y + dy];
        const head = `${tipX - 1.3 * u - 0.8 * v},${-(tipY - 1.3 * v + 0.8 * u)} ${tipX},${-tipY} ${tipX - 1.3 * u + 0.8 * v},${-(tipY - 1.3 * v - 0.8 * u)}`;
        return (
          <g key={point} class="equation-way">
            <line x1={x} y1={-y} x2={tipX} y2={-tipY} />
            <polyline points={head} />
          </g>
        );
      })}
    </>
  );
}
