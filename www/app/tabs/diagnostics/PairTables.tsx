import type { PairPlots } from "../../../worker/protocol";
import { correlation, deviation } from "../../comparison/diagnosing";
import { number, percent } from "../../text/format";
import { DataTable } from "../../ui/DataTable";

interface TablesProps {
  diagnostics: PairPlots;
  pairs: [number, number][];
  shares: number[];
  model: string;
  file: string;
}

/** Tables of the means, standard deviations and correlations that the pair plots show. */
export function PairTables({ diagnostics, pairs, shares, model, file }: TablesProps) {
  const { modes, fit } = diagnostics;
  const plain = (value: number) => number(value, 3);
  return (
    <>
      <DataTable
        file={`${file}-modes`}
        caption={`Mean and SD in the first modes, in SD of ${model}`}
        corner="Mode"
        columns={[
          { title: "Mean", show: plain },
          { title: "SD", show: plain },
          ...(fit
            ? [
                { title: "Mean of fit", show: plain },
                { title: "SD of fit", show: plain },
              ]
            : []),
        ]}
        rows={modes.map((mode, i) => ({
          head: mode + 1,
          values: [
            diagnostics.mean[i],
            deviation(diagnostics, i),
            ...(fit ? [fit.mean[i], deviation(fit, i)] : []),
          ],
        }))}
      />
      <DataTable
        file={file}
        caption="Correlation, and share of the draws within 2 SD"
        corner="Modes"
        columns={[
          { title: "Correlation", show: plain },
          ...(fit ? [{ title: "of the fit", show: plain }] : []),
          { title: "within 2 SD", show: percent },
        ]}
        rows={pairs.map(([i, j], row) => ({
          head: `${i + 1}, ${j + 1}`,
          values: [
            correlation(diagnostics, i, j),
            ...(fit ? [correlation(fit, i, j)] : []),
            shares[row],
          ],
        }))}
      />
    </>
  );
}
