import type { DifferenceDefinition, Settings } from "../../worker/protocol";
import { DEFINITIONS } from "../comparison/words";
import {
  budgetOf,
  DEFAULTS,
  DIFFERENCES,
  FITS,
  type Options,
  PLAUSIBILITIES,
  parseCount,
  parsePercent,
  parsePositive,
  parseSeed,
  percentText,
  rangeOf,
  rangeOfDraws,
  SAMPLERS,
  SIDES_USED,
} from "../state/settings";
import { change, settings, slots, unit } from "../state/state";
import { Choice } from "../ui/Choice";
import { TypedField } from "../ui/TypedField";
import { SigmaField } from "./SigmaField";

/** Settings of the next run: tolerance σ, sampler, modes, seed, numbers of chains and draws, and rarely used ones. */
export function SettingsPanel() {
  const now = settings.value;
  return (
    <section class="settings" aria-label="Settings">
      <SigmaField />
      <Choice
        label="Sampler"
        value={now.sampler}
        options={SAMPLERS}
        standard={DEFAULTS.sampler}
        onChoose={(sampler) => change({ sampler, ...budgetOf(sampler) })}
      />
      <ModesField />
      <TypedField
        label="Seed"
        value={now.seed}
        standard={DEFAULTS.seed}
        parse={parseSeed}
        onChange={(seed) => change({ seed })}
        wrong="a whole number below 2⁶⁴"
        help="Seed of the random number generator. The same seed gives the same draws, to the last bit; another one gives other draws from the same distribution."
      />
      <CountField
        label="Chains"
        name="chains"
        standard={budgetOf(now.sampler).chains}
        range={rangeOf("chains")}
        help="Markov chains for each model. With more chains convergence is checked better; each chain has fewer draws."
        onChange={(chains) =>
          change({ chains, draws: Math.max(now.draws, rangeOfDraws(chains)[0]) })
        }
      />
      <CountField
        label="Draws per model"
        name="draws"
        standard={budgetOf(now.sampler).draws}
        range={rangeOfDraws(now.chains)}
        help="Shapes drawn of the intersection from A, and as many from B. Four times as many halve the Monte-Carlo errors; the time grows in proportion."
      />
      <More />
    </section>
  );
}

const RARE = [
  "fit",
  "pooling",
  "plausibility",
  "noise",
  "weighted",
  "permutations",
  "difference",
  "differenceQuantile",
  "differenceThreshold",
  "differenceDraws",
] as const satisfies (keyof Settings)[];

function More() {
  const now = settings.value;
  const changed = RARE.filter((name) => now[name] !== DEFAULTS[name]).length;
  return (
    <details class="more-settings">
      <summary>
        More{changed > 0 && <span class="standard">&nbsp;· {changed} changed</span>}
      </summary>
      <Choice
        label="Fit"
        value={now.fit}
        options={FITS}
        standard={DEFAULTS.fit}
        onChoose={(fit) => change({ fit })}
      />
      <Choice
        label="Sampled from"
        value={now.pooling}
        options={SIDES_USED}
        standard={DEFAULTS.pooling}
        onChoose={(pooling) => change({ pooling })}
      />
      <Choice
        label="Plausibility"
        value={now.plausibility}
        options={PLAUSIBILITIES}
        standard={DEFAULTS.plausibility}
        onChoose={(plausibility) => change({ plausibility })}
        alwaysHelp
      />
      <TypedField
        label="Noise level"
        value={now.noise === null ? "" : String(now.noise)}
        standard=""
        placeholder="none"
        suffix={unit.value}
        parse={parsePositive}
        onChange={(noise) => change({ noise })}
        wrong={`a positive length in ${unit.value}`}
        help="How far a true member of either population lies from its own model; the recommended σ takes it into account. A larger level raises the recommended σ."
      />
      <CountField
        label="Weighted"
        accessibleLabel="Weighted draws"
        name="weighted"
        standard={DEFAULTS.weighted}
        range={rangeOf("weighted")}
        suffix="draws"
        help="Weighted draws with gradients, for each model, that correct the mean and variance of the fit. Four times as many halve the standard errors."
      />
      <CountField
        label="Relabellings"
        name="permutations"
        standard={DEFAULTS.permutations}
        range={rangeOf("permutations")}
        help="How often the training shapes are divided at random into two groups, to see what chance would give; 0 for none. With more the p-values are more exact: 99 are too few for a small p, 999 are usual."
      />
      <h3>Differences</h3>
      <DifferenceFields />
    </details>
  );
}

const DEFINED = Object.fromEntries(
  DIFFERENCES.map((name) => {
    const { label, help } = DEFINITIONS[name];
    return [name, { label: label.charAt(0).toUpperCase() + label.slice(1), help }];
  }),
) as Options<DifferenceDefinition>;

function DifferenceFields() {
  const now = settings.value;
  const scoreUnit = { soft: "", distance: unit.value, relative: "× its own", outside: "SD" };
  return (
    <>
      <Choice
        label="Definition"
        value={now.difference}
        options={DEFINED}
        standard={DEFAULTS.difference}
        onChoose={(difference) => change({ difference, differenceThreshold: null })}
        alwaysHelp
      />
      {now.difference !== "soft" && (
        <>
          <TypedField
            label="Leaves out"
            value={percentText(now.differenceQuantile)}
            standard={percentText(DEFAULTS.differenceQuantile)}
            suffix="% of the shapes"
            parse={parsePercent}
            onChange={(differenceQuantile) =>
              change({ differenceQuantile, differenceThreshold: null })
            }
            wrong="0 to below 100"
            help="Share of the model’s own shapes that are not in its difference. A larger share keeps only shapes that are less like the other model."
          />
          <TypedField
            label="Threshold"
            value={now.differenceThreshold === null ? "" : String(now.differenceThreshold)}
            standard=""
            placeholder="none"
            suffix={scoreUnit[now.difference]}
            parse={parsePositive}
            onChange={(differenceThreshold) => change({ differenceThreshold })}
            wrong="a positive number, or nothing"
            help="Least score of a shape in the difference, instead of a share of the shapes. A larger threshold keeps fewer shapes, less like the other model."
          />
        </>
      )}
      <CountField
        label="Draws"
        accessibleLabel="Draws of a difference"
        name="differenceDraws"
        standard={DEFAULTS.differenceDraws}
        range={rangeOf("differenceDraws")}
        help="Shapes drawn of each difference. Four times as many halve the standard errors of its mean."
      />
    </>
  );
}

function ModesField() {
  const now = settings.value;
  const most = Math.max(slots.a.value?.report.modes ?? 0, slots.b.value?.report.modes ?? 0);
  return (
    <TypedField
      label="Modes used"
      value={now.modes === null ? "" : String(now.modes)}
      standard=""
      placeholder="all"
      suffix={most > 0 ? `of ${most}` : ""}
      parse={(text) =>
        text.trim() === "" || text.trim() === "all" ? null : parseCount(text, ...rangeOf("modes"))
      }
      onChange={(modes) => change({ modes })}
      wrong="a whole number, or nothing for all"
      help="The first modes of both models. With fewer modes both models are less flexible and the comparison is faster; the variance of the modes left out counts as noise."
    />
  );
}

interface CountFieldProps {
  label: string;
  accessibleLabel?: string;
  name: "chains" | "draws" | "weighted" | "permutations" | "differenceDraws";
  standard: number;
  range: readonly [number, number];
  onChange?: (value: number) => void;
  suffix?: string;
  help?: string;
}

function CountField({ name, standard, range, onChange, ...shown }: CountFieldProps) {
  const [least, most] = range;
  return (
    <TypedField
      {...shown}
      value={String(settings.value[name])}
      standard={String(standard)}
      parse={(text) => parseCount(text, least, most)}
      onChange={onChange ?? ((value) => change({ [name]: value }))}
      wrong={`${least} to ${most.toLocaleString("en").replaceAll(",", "\u202f")}`}
    />
  );
}
