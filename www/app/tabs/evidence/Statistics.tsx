import type { EvidenceReport, Statistic, StatisticName } from "../../../worker/protocol";
import { pText } from "../../comparison/answer";
import {
  type HypothesisName,
  STATISTICS,
  statisticSentence,
  statisticText,
} from "../../comparison/evidence";
import { number, percent } from "../../text/format";
import { plain } from "../../text/phrase";
import { tickText } from "../../text/plots";
import { Chart } from "../../ui/Chart";
import { DataTable } from "../../ui/DataTable";
import { Histogram } from "../../ui/Histogram";
import { InTurn } from "../../ui/InTurn";
import { Phrase } from "../../ui/Phrase";
import { ShowNumbers } from "../../ui/ShowNumbers";
import { HistogramTable } from "./HistogramTable";

interface Props {
  evidence: EvidenceReport;
  name: HypothesisName;
  unit: string;
}

/** Every statistic of a hypothesis: its values under relabelling with the observed one, and all as a table. */
export function Statistics({ evidence, name, unit }: Props) {
  const { statistics } = evidence[name];
  return (
    <>
      <div class="histograms">
        <InTurn
          parts={statistics.map((one, index) => {
            const sentence = statisticSentence(evidence, name, index, unit);
            const title = STATISTICS[one.name];
            return (
              <Chart
                key={one.name}
                name={`${name}-${one.name}`}
                title={title}
                about={<Phrase parts={sentence} />}
                label={`${title} under relabelling. ${plain(sentence)}`}
                height={() => 132}
                draw={(width) => (
                  <Histogram
                    width={width}
                    height={132}
                    chance={one.chance}
                    observed={one.observed}
                    acrossName={axisName(one, unit)}
                    show={isShare(one.name) ? percent : tickText}
                  />
                )}
                table={() => (
                  <HistogramTable
                    file={`chance-${name}-${one.name}`}
                    caption={`${title}, relabelled`}
                    path={`evidence.${name}.statistics.${index}.chance`}
                    chance={one.chance}
                    show={(value) => statisticText(one.name, value, unit)}
                  />
                )}
              />
            );
          })}
        />
      </div>
      <ShowNumbers label="All statistics as a table">
        {() => (
          <DataTable
            file={`evidence-${name}`}
            caption="Statistics, what relabelling gives, and p"
            corner="Statistic"
            columns={COLUMNS.map(({ title, path, show = number }) => ({
              title,
              show,
              metric: (row) => `evidence.${name}.statistics.${row}.${path}`,
            }))}
            rows={statistics.map((one) => ({
              head: STATISTICS[one.name],
              values: COLUMNS.map(({ of }) => of(one)),
            }))}
          />
        )}
      </ShowNumbers>
    </>
  );
}

interface StatisticColumn {
  title: string;
  path: string;
  of: (one: Statistic) => number;
  show?: (value: number) => string;
}

const COLUMNS: StatisticColumn[] = [
  { title: "observed", path: "observed", of: (one) => one.observed },
  { title: "by chance", path: "chance.mean", of: (one) => one.chance.mean },
  { title: "its SD", path: "chance.standardDeviation", of: (one) => one.chance.standardDeviation },
  { title: "5 %", path: "chance.p05", of: (one) => one.chance.p05 },
  { title: "95 %", path: "chance.p95", of: (one) => one.chance.p95 },
  { title: "p", path: "p", of: (one) => one.p, show: pText },
  { title: "its error", path: "pError", of: (one) => one.pError, show: pText },
  { title: "adjusted", path: "pAdjusted", of: (one) => one.pAdjusted, show: pText },
];

const isShare = (name: StatisticName) =>
  name === "varianceAOutsideB" || name === "varianceBOutsideA";

function axisName({ name }: Statistic, unit: string): string {
  if (name === "means" || name === "distanceAToB" || name === "distanceBToA") return unit;
  if (name === "principalAngles") return "rad²";
  return isShare(name) ? "share of the variance" : "|log|";
}
