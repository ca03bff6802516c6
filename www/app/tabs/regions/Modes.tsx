import type { Report } from "../../../worker/protocol";
import { unsettled, unsettledModes } from "../../comparison/words";
import { degrees, number, percent } from "../../text/format";
import { Metric } from "../../ui/Phrase";
import { SaveTable } from "../../ui/SaveTable";
import { Scree } from "../../ui/Scree";
import { ShowNumbers } from "../../ui/ShowNumbers";

/** Standard deviations of the modes of the intersection model, with their standard errors. */
export function Modes({ report }: { report: Report }) {
  const { standardDeviations: deviations, accuracy } = report.intersection;
  if (deviations.length === 0) return null;
  const doubtful = new Set(unsettledModes(accuracy?.modeTurns ?? []).flat());
  const sentence = unsettled(report);
  const { unit } = report.models.a;
  return (
    <details class="more">
      <summary>The modes of A∩B</summary>
      <figure class="scree">
        <Scree
          deviations={deviations}
          side="ab"
          errors={accuracy?.standardDeviations}
          doubtful={doubtful}
        />
        <figcaption>
          SD per mode of the whole shape, {unit}
          {accuracy ? "; bars: ± 2 standard errors; dashed: not determined one by one" : ""}
        </figcaption>
      </figure>
      {sentence && <p class="unsettled">{sentence}</p>}
      {accuracy && (
        <p class="small">
          Relative standard error of the covariance:{" "}
          <Metric
            path="intersection.accuracy.covariance"
            value={accuracy.covariance}
            text={percent(accuracy.covariance)}
          />
          . <GrassmannError report={report} />
        </p>
      )}
      <ShowNumbers>{() => <ModesTable report={report} doubtful={doubtful} />}</ShowNumbers>
    </details>
  );
}

function GrassmannError({ report }: { report: Report }) {
  const found = report.intersection.accuracy?.grassmann ?? [];
  const shown = [1, 3, 5, 10].filter((modes) => found[modes - 1] !== undefined);
  if (shown.length === 0) return null;
  return (
    <>
      Expected error of the Grassmann distance of the first {shown.join(", ")} modes:{" "}
      {shown.map((modes, i) => (
        <span key={modes}>
          {i > 0 && ", "}
          <Metric
            path={`intersection.accuracy.grassmann.${modes - 1}`}
            value={found[modes - 1] ?? Number.NaN}
            text={number(found[modes - 1] ?? Number.NaN, 2)}
          />
        </span>
      ))}{" "}
      radians.
    </>
  );
}

function ModesTable({ report, doubtful }: { report: Report; doubtful: Set<number> }) {
  const { standardDeviations: deviations, accuracy } = report.intersection;
  const { unit } = report.models.a;
  const cell = (path: string, value: number | undefined, show: (value: number) => string) => (
    <td>
      {value === undefined ? (
        <span class="dim">–</span>
      ) : (
        <Metric path={`intersection.${path}`} value={value} text={show(value)} />
      )}
    </td>
  );
  return (
    <SaveTable file="modes" of="the modes of A∩B">
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls must be reached by keys */}
      <section class="scrolled" tabIndex={0} aria-label="Modes of the intersection model">
        <table class="numbers" data-columns={accuracy ? 4 : 1}>
          <caption>Modes of A∩B</caption>
          <thead>
            <tr>
              <th scope="col">Mode</th>
              <th scope="col">SD, {unit}</th>
              {accuracy && (
                <>
                  <th scope="col">± error</th>
                  <th scope="col">direction ±</th>
                  <th scope="col">determined</th>
                </>
              )}
            </tr>
          </thead>
          <tbody>
            {deviations.map((deviation, i) => (
              <tr key={i} data-doubtful={doubtful.has(i + 1)}>
                <th scope="row">{i + 1}</th>
                {cell(`standardDeviations.${i}`, deviation, (value) => number(value))}
                {accuracy && (
                  <>
                    {cell(
                      `accuracy.standardDeviations.${i}`,
                      accuracy.standardDeviations[i],
                      (value) => number(value, 2),
                    )}
                    {cell(`accuracy.modeTurns.${i}`, accuracy.modeTurns[i], (value) =>
                      degrees((180 * value) / Math.PI),
                    )}
                    <td>{doubtful.has(i + 1) ? "not alone" : "yes"}</td>
                  </>
                )}
              </tr>
            ))}
          </tbody>
        </table>
      </section>
    </SaveTable>
  );
}
