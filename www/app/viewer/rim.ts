/**
 * Opacity of every vertex by its distance from an open rim, so that a cut surface fades out instead of ending in a
 * hard edge.
 */

/** Opacity per vertex: 0 on the rim, 1 from `rings` edges inwards; null for a closed surface. */
export function rimFade(
  triangles: Uint32Array,
  pointCount: number,
  rings: number,
): Float32Array | null {
  const neighbours = edgesOf(triangles, pointCount);
  const distance = new Int32Array(pointCount).fill(-1);
  let front: number[] = [];
  for (const [edge, uses] of neighbours.uses) {
    if (uses !== 1) continue;
    for (const point of [Math.floor(edge / pointCount), edge % pointCount]) {
      if (distance[point] !== -1) continue;
      distance[point] = 0;
      front.push(point);
    }
  }
  if (front.length === 0) return null;
  for (let ring = 1; ring <= rings; ring += 1) {
    const next: number[] = [];
    for (const point of front) {
      for (const other of neighbours.of[point] ?? []) {
        if (distance[other] !== -1) continue;
        distance[other] = ring;
        next.push(other);
      }
    }
    front = next;
  }
  return Float32Array.from(distance, (steps) => (steps === -1 ? 1 : smooth(steps / rings)));
}

function edgesOf(triangles: Uint32Array, pointCount: number) {
  const uses = new Map<number, number>();
  const of: number[][] = Array.from({ length: pointCount }, () => []);
  for (let i = 0; i < triangles.length; i += 3) {
    for (let corner = 0; corner < 3; corner += 1) {
      const from = triangles[i + corner] ?? 0;
      const to = triangles[i + ((corner + 1) % 3)] ?? 0;
      const key = Math.min(from, to) * pointCount + Math.max(from, to);
      const before = uses.get(key) ?? 0;
      uses.set(key, before + 1);
      if (before === 0) {
        of[from]?.push(to);
        of[to]?.push(from);
      }
    }
  }
  return { uses, of };
}

function smooth(share: number): number {
  return share * share * (3 - 2 * share);
}
