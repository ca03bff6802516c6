interface Props {
  kind: "circle" | "square" | "diamond";
  x: number;
  y: number;
}

/** Mark of a data point: series differ in shape, not only in colour. */
export function Mark({ kind, x, y }: Props) {
  if (kind === "circle") return <circle cx={x} cy={y} r={2.6} />;
  if (kind === "square") return <rect x={x - 2.3} y={y - 2.3} width={4.6} height={4.6} />;
  return <path d={`M${x} ${y - 3.4}l3.4 3.4l-3.4 3.4l-3.4 -3.4Z`} />;
}
