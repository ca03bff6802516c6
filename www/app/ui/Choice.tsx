import type { Options } from "../state/settings";
import { Field } from "./Field";
import { Select } from "./Select";

interface ChoiceProps<T extends string> {
  label: string;
  value: T;
  standard: T;
  options: Options<T>;
  onChoose: (value: T) => void;
  /** Whether the default is explained, too. */
  alwaysHelp?: boolean;
}

/** A setting with a few named choices. */
export function Choice<T extends string>(props: ChoiceProps<T>) {
  const { label, value, standard, options, onChoose, alwaysHelp = false } = props;
  const names = Object.keys(options) as T[];
  const about = `${label.replace(/\W+/g, "-").toLowerCase()}-about`;
  const { help } = options[value];
  return (
    <>
      <Field
        label={label}
        changed={value !== standard}
        onReset={() => onChoose(standard)}
        help={help}
      >
        <Select
          label={label}
          describedBy={about}
          value={value}
          options={names.map((name) => [
            name,
            `${options[name].label}${name === standard && value !== name ? " (default)" : ""}`,
          ])}
          onChoose={onChoose}
        />
      </Field>
      <p id={about} class={alwaysHelp || value !== standard ? "field-help" : "unseen"}>
        {help}
      </p>
    </>
  );
}
