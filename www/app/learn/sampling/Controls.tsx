/** Controls of the scenes with samplers: models, σ, sampler, chains, draws, seed. */

import { parseSeed } from "../../state/settings";
import { count } from "../../text/format";
import { Select } from "../../ui/Select";
import { Slider } from "../parts/controls";
import { PAIRS } from "../scenes";
import { PAIR_NAMES, SAMPLER_NAMES } from "./names";

type Pair = (typeof PAIRS)[number];

const PLANE_SIGMA = 0.3;
/** Least number of draws or steps of a scene. */
const LEAST_COUNT = 16;

interface NamedProps<T extends string> {
  label: string;
  value: T;
  options: readonly T[];
  names: Readonly<Record<string, string>>;
  onChange: (value: T) => void;
}

function NamedChoice<T extends string>(props: NamedProps<T>) {
  const { label, value, options, names, onChange } = props;
  return (
    <label class="lesson-choice">
      <span class="lesson-label">{label}</span>
      <Select
        value={value}
        options={options.map((option) => [option, names[option] ?? option])}
        onChoose={onChange}
      />
    </label>
  );
}

type Common<T extends string> = Pick<NamedProps<T>, "value" | "options" | "onChange">;

export function PairChoice<T extends string>(props: Common<T>) {
  return <NamedChoice label="Models" names={PAIR_NAMES} {...props} />;
}

interface AnyPairProps {
  value: Pair;
  /** σ of the scene for pairs of stars. */
  starSigma: number;
  onChange: (chosen: { pair: Pair; sigma: number }) => void;
}

/** Chooses a pair of stars or the planes, each with a suitable σ. */
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
  return <NamedChoice label="Sampler" names={SAMPLER_NAMES} {...props} />;
}

const SIDE_NAMES = { a: "of A, near B", b: "of B, near A" };

export function SideChoice(props: { value: "a" | "b"; onChange: (value: "a" | "b") => void }) {
  return <NamedChoice label="Shapes" options={["a", "b"]} names={SIDE_NAMES} {...props} />;
}

/** Slider for a number of draws or steps on a logarithmic scale. */
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

/** Field for the seed of the random numbers, with a button for the next one. */
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
