/** Outline of a star for illustrations, without a model. Pure. */

/** Points xyxy… of a star, the top tip first, then anticlockwise; each tip is rotated by `turned` degrees. */
export function starOf(turned: readonly number[]): number[] {
  return Array.from({ length: 10 }, (_, point) => {
    const tip = point % 2 === 0;
    const deviation = tip ? ((turned[point / 2] ?? 0) * Math.PI) / 180 : 0;
    const angle = Math.PI / 2 + (point * Math.PI) / 5 + deviation;
    const radius = tip ? 10 : 3;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  }).flat();
}

/** The same as an SVG path, whose y axis points down. */
export function pathOf(shape: readonly number[]): string {
  const points: string[] = [];
  for (let at = 0; at < shape.length; at += 2) {
    points.push(`${(shape[at] ?? 0).toFixed(2)} ${(-(shape[at + 1] ?? 0)).toFixed(2)}`);
  }
  return `M${points.join("L")}Z`;
}
