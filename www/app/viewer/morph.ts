/**
 * Computes normals, colours and blends of a moving shape into existing buffers, without allocation, so that a slider
 * can do it sixty times a second. Pure.
 */

/**
 * Vertex normals, of unit length, weighted by the areas of the triangles round each vertex. Points
 * of no triangle, or of flat ones alone, keep the zero vector.
 */
export function writeNormals(
  points: Float32Array,
  triangles: Uint32Array,
  normals: Float32Array,
): void {
  normals.fill(0);
  for (let t = 0; t + 2 < triangles.length; t += 3) {
    const a = 3 * at(triangles, t);
    const b = 3 * at(triangles, t + 1);
    const c = 3 * at(triangles, t + 2);
    const x = at(points, c);
    const y = at(points, c + 1);
    const z = at(points, c + 2);
    const ux = x - at(points, b);
    const uy = y - at(points, b + 1);
    const uz = z - at(points, b + 2);
    const vx = at(points, a) - at(points, b);
    const vy = at(points, a + 1) - at(points, b + 1);
    const vz = at(points, a + 2) - at(points, b + 2);
    const nx = uy * vz - uz * vy;
    const ny = uz * vx - ux * vz;
    const nz = ux * vy - uy * vx;
    add(normals, a, nx, ny, nz);
    add(normals, b, nx, ny, nz);
    add(normals, c, nx, ny, nz);
  }
  for (let i = 0; i + 2 < normals.length; i += 3) {
    const x = at(normals, i);
    const y = at(normals, i + 1);
    const z = at(normals, i + 2);
    const size = Math.sqrt(x * x + y * y + z * z);
    const scale = size > 0 ? 1 / size : 0;
    normals[i] = x * scale;
    normals[i + 1] = y * scale;
    normals[i + 2] = z * scale;
  }
}

/**
 * Red, green and blue of every vertex from its value; the opacities between them stay. `table`
 * holds the colours from `low` to `high`, three numbers each.
 */
export function writeColours(
  values: Float32Array,
  [low, high]: readonly [number, number],
  table: Float32Array,
  colours: Float32Array,
): void {
  const last = table.length / 3 - 1;
  const scale = last / Math.max(high - low, 1e-30);
  for (let i = 0; i < values.length; i += 1) {
    const place = (at(values, i) - low) * scale;
    // NaN has the lowest colour.
    const entry = 3 * (place > 0 ? Math.min(last, Math.round(place)) : 0);
    colours[4 * i] = at(table, entry);
    colours[4 * i + 1] = at(table, entry + 1);
    colours[4 * i + 2] = at(table, entry + 2);
  }
}

/** Magnifies the deviation from the mean: mean + times · (shape − mean). */
export function magnified(shape: Float32Array, mean: Float32Array, times: number): Float32Array {
  return times === 1 ? shape : blended(mean, shape, times);
}

/** Interpolates linearly: one + share · (other − one). */
export function blended(one: Float32Array, other: Float32Array, share: number): Float32Array {
  const made = new Float32Array(other.length);
  for (let i = 0; i < made.length; i += 1) {
    const from = at(one, i);
    made[i] = from + share * (at(other, i) - from);
  }
  return made;
}

/** Reads an array element without a check: the indices are known to be valid, and checks would slow the loops. */
function at(list: Float32Array | Uint32Array, index: number): number {
  return list[index] as number;
}

function add(list: Float32Array, index: number, x: number, y: number, z: number): void {
  list[index] = at(list, index) + x;
  list[index + 1] = at(list, index + 1) + y;
  list[index + 2] = at(list, index + 2) + z;
}
