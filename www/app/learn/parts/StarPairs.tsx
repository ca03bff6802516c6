import { Select } from "../../ui/Select";
import { STAR_PAIRS } from "../scenes";

type StarPair = (typeof STAR_PAIRS)[number];

interface Props {
  label: string;
  value: StarPair;
  onChoose: (pair: StarPair) => void;
}

/** Chooses one of the paper’s pairs of stars. */
export function StarPairs({ label, value, onChoose }: Props) {
  return (
    <label>
      {label}{" "}
      <Select
        value={value}
        options={STAR_PAIRS.map((name) => [name, `pair ${name.slice(-1)}`])}
        onChoose={onChoose}
      />
    </label>
  );
}
