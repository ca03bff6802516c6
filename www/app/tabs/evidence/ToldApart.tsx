import type { EvidenceReport, Side } from "../../../worker/protocol";
import { toldApartSentence } from "../../comparison/groups";
import { percent } from "../../text/format";
import { plain } from "../../text/phrase";
import { Chart } from "../../ui/Chart";
import { Histogram } from "../../ui/Histogram";
import { Phrase } from "../../ui/Phrase";
import { HistogramTable } from "./HistogramTable";

/** How many left-out shapes of a group are nearer to their own model, and by chance. */
export function ToldApart({ evidence, side }: { evidence: EvidenceReport; side: Side }) {
  const { share, chance } = evidence.toldApart[side];
  const name = side.toUpperCase();
  const sentence = toldApartSentence(evidence, side);
  return (
    <Chart
      name={`told-apart-${side}`}
      title={`Shapes of ${name}`}
      about={<Phrase parts={sentence} />}
      label={plain(sentence)}
      height={() => 132}
      draw={(width) => (
        <Histogram
          width={width}
          height={132}
          chance={chance}
          observed={share}
          acrossName="share nearer to their own model"
          show={percent}
        />
      )}
      table={() => (
        <HistogramTable
          file={`told-apart-${side}`}
          caption={`Share of shapes of ${name} nearer to their own model, relabelled`}
          path={`evidence.toldApart.${side}.chance`}
          chance={chance}
          show={percent}
        />
      )}
    />
  );
}
