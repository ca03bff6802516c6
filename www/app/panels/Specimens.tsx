import { useSignal } from "@preact/signals";
import type { Column, SpecimenTable } from "../../worker/protocol";
import {
  countsOf,
  type Division,
  dividedBy,
  FEWEST,
  firstDivision,
  numbersOf,
} from "../models/division";
import { compareGroups, modelOfEachGroup, type ShownSet, shownSet } from "../models/specimens";
import { SIDES, sourceKey, tab } from "../state/state";
import { count, number } from "../text/format";
import { Modal } from "../ui/Modal";
import { Select } from "../ui/Select";

/** Longer tables are cut: what is shown serves to check names and columns. */
const MOST_ROWS = 500;

/** Dialog with the specimens of a set, to divide it into A and B. */
export function Specimens() {
  const set = shownSet.value;
  return set && <Dialog key={sourceKey(set.source)} set={set} />;
}

function Dialog({ set }: { set: ShownSet }) {
  const { name, table } = set;
  const division = useSignal(firstDivision(table, set.reading));
  const close = () => {
    if (shownSet.peek() === set) shownSet.value = null;
  };
  const change = (patch: Partial<Division>) => {
    if (division.value) division.value = { ...division.value, ...patch };
  };
  const known = division.value;
  return (
    <Modal title={`Specimens of ${name}`} onClose={close}>
      <div class="specimens">
        {known ? (
          <Divide set={set} division={known} change={change} />
        ) : (
          <p>
            Nothing is known that divides the specimens. Drop a table beside the set: a first line
            of names, a column that names the specimens or their files, and columns of groups, sexes
            or ages.
          </p>
        )}
        <Table table={table} division={known} change={change} />
      </div>
    </Modal>
  );
}

interface DivideProps {
  set: ShownSet;
  division: Division;
  change: (patch: Partial<Division>) => void;
}

/** Which column divides the set, into which groups, and what is filtered or taken out before. */
function Divide({ set, division, change }: DivideProps) {
  const { table } = set;
  const { columns } = table;
  const dividing = columns.filter(({ kind, values }) => kind === "numbers" || values.length > 1);
  const column = columns.find(({ name }) => name === division.column);
  const counts = countsOf(table, division);
  const few = SIDES.filter((side) => counts[side] < FEWEST);
  const numbers = columns.filter(({ kind }) => kind === "numbers");
  const groups = columns.filter(({ kind }) => kind === "groups");
  const many = column?.kind === "groups" && column.values.length > 2;
  return (
    <form
      class="divide"
      onSubmit={(event) => {
        event.preventDefault();
        void compareGroups(set, division);
      }}
    >
      <div class="divide-row">
        <label>
          <span>Divide by</span>
          <Select
            value={division.column}
            options={dividing.map(({ name }) => [name, name] as const)}
            onChoose={(name) => {
              const chosen = columns.find((one) => one.name === name);
              if (chosen) change(dividedBy(table, chosen));
            }}
          />
        </label>
        {column?.kind === "groups" && <Words column={column} division={division} change={change} />}
      </div>
      {division.threshold !== null && (
        <Threshold table={table} division={division} change={change} />
      )}
      <div class="divide-row">
        {groups.length > 0 && (
          <label>
            <span>Only where</span>
            <Select
              value={division.only ? `${division.only.column}\n${division.only.word}` : ""}
              options={[
                ["", "– all specimens –"],
                ...groups
                  .filter(({ name }) => name !== division.column)
                  .flatMap(({ name, values }) =>
                    values.map(({ word }) => [`${name}\n${word}`, `${name} = ${word}`] as const),
                  ),
              ]}
              onChoose={(text) => {
                const [name = "", word = ""] = text.split("\n");
                change({ only: text === "" ? null : { column: name, word } });
              }}
            />
          </label>
        )}
        <label title="The regression within the groups is removed: shapes as they would be at the mean of all. What is left between the groups does not follow from it.">
          <span>Take out what follows</span>
          <Select
            value={division.adjust ?? ""}
            options={[
              ["", "– nothing –"],
              ["size", "log centroid size"],
              ...numbers.map(({ name }) => [name, name] as const),
            ]}
            onChoose={(name) => change({ adjust: name === "" ? null : name })}
          />
        </label>
      </div>
      <div class="divide-row" role="status">
        <span class="letter" data-side="a">
          A
        </span>
        <span>{count(counts.a)} specimens</span>
        <span class="letter" data-side="b">
          B
        </span>
        <span>{count(counts.b)} specimens</span>
      </div>
      {few.length > 0 && (
        <p class="wrong">
          A model takes at least {FEWEST} specimens: choose other groups for{" "}
          {few.map((side) => side.toUpperCase()).join(" and ")}.
        </p>
      )}
      <div class="card-row">
        <button type="submit" class="primary" disabled={few.length > 0}>
          Compare A and B
        </button>
        {many && (
          <button
            type="button"
            onClick={() => {
              tab.value = "models";
              void modelOfEachGroup(set, division);
            }}
          >
            A model of each group
          </button>
        )}
      </div>
      <p class="note">
        All specimens that are read are superimposed together, so that the groups need no further
        alignment.
      </p>
    </form>
  );
}

/** Which words make A and which B. */
function Words({
  column,
  division,
  change,
}: {
  column: Column;
  division: Division;
  change: (patch: Partial<Division>) => void;
}) {
  const words = column.values.map(
    ({ word, count: found }) => [word, `${word} (${count(found)})`] as const,
  );
  return (
    <>
      <label>
        <span class="letter" data-side="a">
          A
        </span>
        <Select
          label="Group A"
          value={division.a}
          options={words}
          onChoose={(a) => change({ a })}
        />
      </label>
      <label>
        <span class="letter" data-side="b">
          B
        </span>
        <Select
          label="Group B"
          value={division.b ?? ""}
          options={[...words, ["", "all others"] as const]}
          onChoose={(b) => change({ b: b === "" ? null : b })}
        />
      </label>
    </>
  );
}

const BARS = 24;
const [WIDTH, HEIGHT] = [320, 64];

/** Histogram of a column of numbers with the threshold between A and B. */
function Threshold({
  table,
  division,
  change,
}: {
  table: SpecimenTable;
  division: Division;
  change: (patch: Partial<Division>) => void;
}) {
  const numbers = numbersOf(table, division.column);
  const [least, most] = [Math.min(...numbers), Math.max(...numbers)];
  const threshold = division.threshold ?? least;
  const step = (most - least) / BARS || 1;
  const bars = Array.from({ length: BARS }, () => 0);
  for (const one of numbers) {
    const place = Math.min(BARS - 1, Math.floor((one - least) / step));
    bars[place] = (bars[place] ?? 0) + 1;
  }
  const tallest = Math.max(...bars, 1);
  const across = (value: number) => ((value - least) / (most - least || 1)) * WIDTH;
  const label = `Threshold of ${division.column}`;
  return (
    <div class="threshold">
      <svg
        viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
        role="img"
        aria-label={`Histogram of ${division.column} with its threshold`}
      >
        {bars.map((tall, place) => {
          const middle = least + (place + 0.5) * step;
          return (
            <rect
              key={String(middle)}
              data-side={middle < threshold ? "a" : "b"}
              x={(place * WIDTH) / BARS + 0.5}
              width={WIDTH / BARS - 1}
              y={HEIGHT - (tall / tallest) * HEIGHT}
              height={(tall / tallest) * HEIGHT}
            />
          );
        })}
        <line x1={across(threshold)} x2={across(threshold)} y1={0} y2={HEIGHT} />
      </svg>
      <input
        type="range"
        aria-label={label}
        min={least}
        max={most}
        step="any"
        value={threshold}
        onInput={({ currentTarget }) =>
          change({ threshold: Number(Number(currentTarget.value).toPrecision(4)) })
        }
      />
      <p>
        <span class="letter" data-side="a">
          A
        </span>{" "}
        {division.column} &lt; {number(threshold)}{" "}
        <span class="letter" data-side="b">
          B
        </span>{" "}
        from there on
      </p>
    </div>
  );
}

/** The specimens, each with a box that leaves it out. */
function Table({
  table,
  division,
  change,
}: {
  table: SpecimenTable;
  division: Division | null;
  change: (patch: Partial<Division>) => void;
}) {
  const { columns, specimens } = table;
  const shown = specimens.slice(0, MOST_ROWS);
  const without = division?.without ?? [];
  return (
    <>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls must be reached by keys */}
      <section class="scrolled" tabIndex={0} aria-label="Specimens">
        <table class="numbers data-table">
          <thead>
            <tr>
              {division && <th scope="col">Used</th>}
              <th scope="col">Specimen</th>
              {columns.map(({ name }) => (
                <th key={name} scope="col">
                  {name}
                </th>
              ))}
              <th scope="col" title="Root of the sum of squared distances from the centroid">
                Centroid size
              </th>
            </tr>
          </thead>
          <tbody>
            {shown.map(({ key, name, values, size, missing }) => (
              <tr key={key}>
                {division && (
                  <td>
                    <input
                      type="checkbox"
                      aria-label={`Use ${name}`}
                      checked={!without.includes(key)}
                      onChange={({ currentTarget }) => {
                        const others = without.filter((one) => one !== key);
                        change({ without: currentTarget.checked ? others : [...others, key] });
                      }}
                    />
                  </td>
                )}
                <th scope="row">{name}</th>
                {values.map((value, place) => (
                  <td key={columns[place]?.name}>{value || <span class="dim">–</span>}</td>
                ))}
                <td>
                  {size === null ? <span class="dim">{count(missing)} missing</span> : number(size)}
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </section>
      <p class="note">
        {count(specimens.length)} specimens of {count(table.points)} points in {table.dimension}{" "}
        dimensions
        {specimens.length > shown.length ? `; the first ${count(shown.length)} are shown` : ""}.
      </p>
    </>
  );
}
