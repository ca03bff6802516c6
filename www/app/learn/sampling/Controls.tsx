/** What the scenes that sample let one choose, each with its value beside it. */

import { parseSeed } from "../../state/settings";
import { count } from "../../text/format";
import { Slider } from "../parts/controls";
import { PAIRS } from "../scenes";
import { PAIR_NAMES, SAMPLER_NAMES } from "./names";

type Pair = (typeof PAIRS)[number];

const PLANE_SIGMA = 0.3;
/** As few draws or steps as a scene shows. */
const LEAST_COUNT = 16;

interface SelectProps<T extends string> {
  label: string;
  value: T;
  options: readonly T[];
  names: Readonly<Record<string, string>>;
  onChange: (value: T) => void;
}

export function Select<T extends string>({
  label,
  value,
  options,
  names,
  onChange,
}: SelectProps<T>) {
  return (
    <label class="lesson-choice">
      <span class="lesson-label">{label}</span>
      <select value={value} onChange={(event) => onChange(event.currentTarget.value as T)}>
        {options.map((option) => (
          <option key={option} value={option}>
            {names[option] ?? option}
          </option>
        ))}
      </select>
    </label>
  );
}

type Common<T extends string> = Pick<SelectProps<T>, "value" | "options" | "onChange">;

export function PairChoice<T extends string>(props: Common<T>) {
  return <Select label="Models" names={PAIR_NAMES} {...props} />;
}

interface AnyPairProps {
  value: Pair;
  /** What may differ by so much is called near, where the pair is stars; scenes look at them differently. */
  starSigma: number;
  onChange: (chosen: { pair: Pair; sigma: number }) => void;
}

/** Stars or planes, each with the σ at which there is something to see. */
export function AnyPairChoice({ value, starSigma, onChange }: AnyPairProps) {
  return (
    <PairChoice
      value={value}
      options={PAIRS}
      onChange={(pair) => onChange({ pair, sigma: pair === "planes" ? PLANE_SIGMA : starSigma })}
    />
  );
}

export function SamplerChoice<T extends string>(props: Common<T>) {
  return <Select label="Sampler" names={SAMPLER_NAMES} {...props} />;
}

const SIDE_NAMES = { a: "of A, near B", b: "of B, near A" };

export function SideChoice(props: { value: "a" | "b"; onChange: (value: "a" | "b") => void }) {
  return <Select label="Shapes" options={["a", "b"]} names={SIDE_NAMES} {...props} />;
}

/** Draws or steps, over the logarithm. */
export function CountSlider({ onChange, ...rest }: NumberProps & { label: string; most: number }) {
  return (
    <Slider
      least={LEAST_COUNT}
      step={0}
      logarithmic
      show={count}
      onChange={(value) => onChange(Math.round(value))}
      {...rest}
    />
  );
}

interface NumberProps {
  value: number;
  onChange: (value: number) => void;
}

export function SigmaSlider({
  least,
  most,
  ...rest
}: NumberProps & { least: number; most: number }) {
  return <Slider label="σ" least={least} most={most} step={0} logarithmic {...rest} />;
}

export function ChainSlider({ most = 16, ...rest }: NumberProps & { most?: number }) {
  return <Slider label="Chains" least={1} most={most} step={1} show={String} {...rest} />;
}

/** The seed of every random number, typed or taken anew. */
export function SeedField({
  value,
  onChange,
}: {
  value: string;
  onChange: (value: string) => void;
}) {
  const take = (text: string) => {
    const found = parseSeed(text);
    if (found !== "invalid" && found !== value) onChange(found);
  };
  return (
    <div class="lesson-choice">
      <label class="lesson-label" for="lesson-seed">
        Seed
      </label>
      <span class="lesson-seed">
        <input
          id="lesson-seed"
          type="text"
          inputMode="numeric"
          autocomplete="off"
          value={value}
          onChange={(event) => {
            take(event.currentTarget.value);
            event.currentTarget.value = value;
          }}
        />
        <button type="button" onClick={() => take(String((Number(value) % 1e6) + 1))}>
          Next
        </button>
      </span>
    </div>
  );
}
