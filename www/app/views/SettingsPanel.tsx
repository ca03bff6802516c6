import type { Alignment, SamplerName, Settings } from "../../worker/protocol";
import { number } from "../format";
import {
  ALIGNMENTS,
  budgetOf,
  DEFAULTS,
  parseCount,
  parseSeed,
  parseSigma,
  SAMPLERS,
} from "../settings";
import { chosenPart, result, settings, unit } from "../state";
import { Field } from "./Field";
import { TypedField } from "./TypedField";

function change(part: Partial<Settings>): void {
  settings.value = { ...settings.value, ...part };
}

export function SettingsPanel() {
  const now = settings.value;
  const budget = budgetOf(now.sampler);
  return (
    <section class="settings" aria-label="Settings">
      <SigmaField />
      <Choice
        label="Sampler"
        value={now.sampler}
        options={SAMPLERS}
        standard={DEFAULTS.sampler}
        onChoose={(sampler: SamplerName) => change({ sampler, ...budgetOf(sampler) })}
      />
      <Choice
        label="Align B to A"
        value={now.align}
        options={ALIGNMENTS}
        standard={DEFAULTS.align}
        onChoose={(align: Alignment) => change({ align })}
      />
      <ModesField />
      <TypedField
        label="Seed"
        value={now.seed}
        standard={DEFAULTS.seed}
        parse={parseSeed}
        onChange={(seed) => change({ seed })}
        wrong="a whole number below 2⁶⁴"
      />
      <TypedField
        label="Chains"
        value={String(now.chains)}
        standard={String(budget.chains)}
        parse={(text) => parseCount(text, 2, 1024)}
        onChange={(chains) => change({ chains, draws: Math.max(now.draws, 8 * chains) })}
        wrong="2 to 1024"
      />
      <TypedField
        label="Draws a side"
        value={String(now.draws)}
        standard={String(budget.draws)}
        parse={(text) => parseCount(text, 8 * now.chains, 10_000_000)}
        onChange={(draws) => change({ draws })}
        wrong={`${8 * now.chains} to 10 000 000`}
      />
    </section>
  );
}

function SigmaField() {
  const now = settings.value;
  const used = result.value?.report.settings;
  const recommended = used?.sigmaRecommended ? used.sigma : null;
  return (
    <TypedField
      label="Tolerance σ"
      value={now.sigma === null ? "" : String(now.sigma)}
      standard=""
      placeholder={recommended === null ? "auto" : number(recommended)}
      suffix={unit.value}
      standardWord="recommended"
      parse={parseSigma}
      onChange={(sigma) => change({ sigma })}
      wrong={`a positive length in ${unit.value}`}
      help="How far from a model, on average per point, a shape may lie and still count as one it can make."
    />
  );
}

function ModesField() {
  const now = settings.value;
  const most = Math.max(chosenPart("a")?.report.modes ?? 0, chosenPart("b")?.report.modes ?? 0);
  return (
    <TypedField
      label="Modes used"
      value={now.modes === null ? "" : String(now.modes)}
      standard=""
      placeholder="all"
      suffix={most > 0 ? `of ${most}` : ""}
      parse={(text) =>
        text.trim() === "" || text.trim() === "all" ? null : parseCount(text, 1, 100_000)
      }
      onChange={(modes) => change({ modes })}
      wrong="a whole number, or nothing for all"
    />
  );
}

interface ChoiceProps<T extends string> {
  label: string;
  value: T;
  standard: T;
  options: Record<T, { label: string; help: string }>;
  onChoose: (value: T) => void;
}

function Choice<T extends string>({ label, value, standard, options, onChoose }: ChoiceProps<T>) {
  const names = Object.keys(options) as T[];
  return (
    <Field
      label={label}
      changed={value !== standard}
      onReset={() => onChoose(standard)}
      help={options[value].help}
    >
      <select
        value={value}
        aria-label={label}
        onChange={(event) => onChoose(event.currentTarget.value as T)}
      >
        {names.map((name) => (
          <option key={name} value={name}>
            {options[name].label}
            {name === standard && value !== name ? " (default)" : ""}
          </option>
        ))}
      </select>
    </Field>
  );
}
