/** Finds the vertex under the pointer: of the vertices close to it in the image, the nearest to the camera. */

const REACH_PX = 9;

/**
 * `matrix` takes points to clip space (column major), `x` and `y` are in pixels in a cell of
 * `width` × `height`. Returns the vertex and its depth.
 */
export function pickVertex(
  points: Float32Array,
  dimension: 2 | 3,
  matrix: ArrayLike<number>,
  at: { x: number; y: number; width: number; height: number },
): { vertex: number; depth: number } | null {
  const m = (i: number) => matrix[i] ?? 0;
  let best: { vertex: number; depth: number } | null = null;
  for (let i = 0; i < points.length; i += dimension) {
    const px = points[i] ?? 0;
    const py = points[i + 1] ?? 0;
    const pz = dimension === 3 ? (points[i + 2] ?? 0) : 0;
    const w = m(3) * px + m(7) * py + m(11) * pz + m(15);
    if (w <= 0) continue;
    const sx = ((m(0) * px + m(4) * py + m(8) * pz + m(12)) / w + 1) * 0.5 * at.width - at.x;
    if (sx > REACH_PX || sx < -REACH_PX) continue;
    const sy = (1 - (m(1) * px + m(5) * py + m(9) * pz + m(13)) / w) * 0.5 * at.height - at.y;
    const away = sx * sx + sy * sy;
    if (away > REACH_PX * REACH_PX) continue;
    // A vertex clearly in front is preferred to one slightly closer to the pointer.
    const depth = (m(2) * px + m(6) * py + m(10) * pz + m(14)) / w + away * 1e-5;
    if (best === null || depth < best.depth) best = { vertex: i / dimension, depth };
  }
  return best;
}
