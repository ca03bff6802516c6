import type { LessonModels } from "../../../../worker/protocol";
import { number, withoutRoundingError } from "../../../text/format";
import { TIPS } from "../../shape";
import { TIP_NAMES } from "./tips";

interface Props {
  models: LessonModels;
  /** Tips that both can move. */
  shared: readonly number[];
  guess: readonly number[];
}

const COLUMNS = [
  ["a", "A"],
  ["intersection", "A∩B"],
  ["b", "B"],
] as const;

/** Standard deviation of each tip in A, A∩B and B, as bars and numbers. */
export function TipTable({ models, shared, guess }: Props) {
  const most = Math.max(...COLUMNS.flatMap(([key]) => models[key].vertexSd));
  return (
    <table class="tip-table">
      <caption>Standard deviation of each tip, in units of the star</caption>
      <thead>
        <tr>
          <th scope="col">Tip</th>
          {COLUMNS.map(([key, name]) => (
            <th key={key} scope="col" data-whose={key}>
              {name}
            </th>
          ))}
          <th scope="col">You</th>
        </tr>
      </thead>
      <tbody>
        {TIPS.map((point, tip) => (
          <tr key={point} data-shared={shared.includes(tip)}>
            <th scope="row">{TIP_NAMES[tip]}</th>
            {COLUMNS.map(([key]) => {
              const sd = models[key].vertexSd[point] ?? 0;
              return (
                <td key={key} data-whose={key}>
                  <span class="tip-bar" style={{ width: `${(100 * sd) / most}%` }} />
                  <span class="num" data-metric={`tips.${tip}.${key}`} data-value={sd}>
                    {number(withoutRoundingError(sd, most), 2)}
                  </span>
                </td>
              );
            })}
            <td>{markOf(guess.includes(tip), shared.includes(tip))}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function markOf(guessed: boolean, moves: boolean) {
  if (!guessed && !moves) return null;
  const kind = guessed && moves ? "right" : guessed ? "wrong" : "missed";
  const sign = { right: "✓", wrong: "✕", missed: "○" }[kind];
  return (
    <span class="tip-mark" data-kind={kind}>
      {sign} <span class="tip-mark-word">{kind}</span>
    </span>
  );
}
