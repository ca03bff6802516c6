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
      <select
        value={value}
        onChange={({ currentTarget }) => {
          const chosen = STAR_PAIRS.find((name) => name === currentTarget.value);
          if (chosen) onChoose(chosen);
        }}
      >
        {STAR_PAIRS.map((name) => (
          <option key={name} value={name}>
            pair {name.slice(-1)}
          </option>
        ))}
      </select>
    </label>
  );
}
