import type { Report } from "../../worker/protocol";
import { count, degrees } from "../format";
import { DIAGNOSTICS, GROUPS, type Group, valueAt } from "../numbers";
import { outOfDate, result } from "../state";
import { belief, differences, furtherWarnings, headline, shared, spaces } from "../words";
import { Metric, Phrase } from "./Phrase";

export function Headline() {
  const held = result.value;
  return (
    <h2 class="headline" data-stale={outOfDate.value}>
      {held ? (
        <Phrase parts={headline(held.report, held.nouns)} />
      ) : (
        "Comparing two models of shape."
      )}
    </h2>
  );
}

export function Results() {
  const held = result.value;
  if (!held) return null;
  const { report, nouns } = held;
  const { converged, phrase } = belief(report);
  return (
    <section class="results" aria-label="Results" data-stale={outOfDate.value}>
      <ul class="says">
        <li data-about="intersection">
          <Phrase parts={shared(report)} />
        </li>
        <li data-about="differences">
          <Phrase parts={differences(report, nouns)} />
        </li>
        <li data-about="spaces">
          <Phrase parts={spaces(report)} />
        </li>
        <li data-about="belief" data-converged={converged}>
          <Phrase parts={phrase} />
        </li>
      </ul>
      {furtherWarnings(report).map(({ code, message, hint }) => (
        <p key={code} class="warning" data-code={code}>
          {message} <span class="dim">{hint}</span>
        </p>
      ))}
      {GROUPS.map((group) => (
        <Numbers key={group.title} group={group} report={report} />
      ))}
      <details class="more">
        <summary>Can these draws be believed?</summary>
        <Numbers group={DIAGNOSTICS} report={report} />
        <p class="small">
          R-hat (rank-normalised, split) should be below 1.01 and ESS above {count(400)}; Pareto k
          below 0.7. A difference is sampled exactly, so its draws are independent and have no
          R-hat.
        </p>
        <Angles angles={report.overlap.principalAnglesDegrees} />
      </details>
    </section>
  );
}

function Numbers({ group, report }: { group: Group; report: Report }) {
  return (
    <table class="numbers" data-columns={group.columns.length}>
      <caption>{group.title}</caption>
      {group.columns.length > 0 && (
        <thead>
          <tr>
            <td />
            {group.columns.map((column) => (
              <th key={column} scope="col">
                {column}
              </th>
            ))}
          </tr>
        </thead>
      )}
      <tbody>
        {group.rows.map((row) => (
          <tr key={row.label}>
            <th scope="row">{row.label}</th>
            {row.metrics.map((path) => {
              const value = valueAt(report, path);
              return (
                <td key={path}>
                  {value === null ? (
                    <span class="dim">–</span>
                  ) : (
                    <Metric path={path} value={value} text={row.show(value, report)} />
                  )}
                </td>
              );
            })}
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Angles({ angles }: { angles: number[] }) {
  if (angles.length === 0) return null;
  return (
    <div class="angles">
      <h3>Principal angles between the two spaces</h3>
      <ol>
        {angles.map((angle, i) => {
          const path = `overlap.principalAnglesDegrees.${i}`;
          return (
            <li key={path}>
              <Metric path={path} value={angle} text={degrees(angle)} />
            </li>
          );
        })}
      </ol>
    </div>
  );
}
