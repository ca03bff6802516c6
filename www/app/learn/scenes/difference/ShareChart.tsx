import { number, percent } from "../../../text/format";
import { linear, logarithmic } from "../../../text/plots";
import { Chart } from "../../../ui/Chart";
import { DataTable } from "../../../ui/DataTable";
import { type Box, PlotAxes } from "../../../ui/PlotAxes";
import { letterSpace } from "../../parts/lettering";
import type { Share } from "./asks";

const HEIGHT = 190;

interface Props {
  shares: readonly Share[];
  sigma: number;
  own: string;
  other: string;
}

/** Plot of the share of a model that the other cannot make, over σ, with the σ in use. */
export function ShareChart({ shares, sigma, own, other }: Props) {
  const [first, last] = [shares[0], shares.at(-1)];
  if (!first || !last) return null;
  return (
    <Chart
      name="shares"
      title="Share of the difference over σ"
      about={`Share of ${own} that ${other} cannot make. At small σ it is all of it.`}
      label={`Share of ${own} that ${other} cannot make: ${percent(first.share)} at σ = ${number(first.sigma)}, ${percent(last.share)} at σ = ${number(last.sigma)}.`}
      height={() => HEIGHT}
      draw={(width) => <Line shares={shares} sigma={sigma} width={width} />}
      table={() => (
        <DataTable
          file="difference-over-sigma"
          caption={`Share of ${own} that ${other} cannot make`}
          corner="σ"
          columns={[{ title: "share", show: percent }]}
          rows={shares.map(({ sigma, share }) => ({ head: number(sigma), values: [share] }))}
        />
      )}
    />
  );
}

function Line({ shares, sigma, width }: Pick<Props, "shares" | "sigma"> & { width: number }) {
  const box: Box = {
    left: letterSpace(44),
    right: width - 10,
    top: 14,
    bottom: HEIGHT - letterSpace(36),
  };
  const [first, last] = [shares[0]?.sigma ?? 0.01, shares.at(-1)?.sigma ?? 1];
  const x = logarithmic(first, last, box.left, box.right);
  const y = linear(0, 1, box.bottom, box.top);
  return (
    <g class="shares">
      <PlotAxes
        box={box}
        x={x}
        y={y}
        across={[0.01, 0.1, 1]}
        up={[0, 0.5, 1]}
        acrossName=""
        upName=""
        showUp={percent}
      />
      <text class="tick axis-name" x={box.right} y={box.bottom + letterSpace(30)} text-anchor="end">
        σ
      </text>
      <polyline
        class="share"
        points={shares.map((one) => `${x(one.sigma)},${y(one.share)}`).join(" ")}
      />
      <line class="used" x1={x(sigma)} x2={x(sigma)} y1={box.top} y2={box.bottom} />
    </g>
  );
}
