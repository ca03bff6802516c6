/** Populations of shapes for tests, as files. */

/** A box of 4 × 4 × 4 points, stretched and turned a little, another one for each number. */
function mesh(number) {
  const [wide, tall, turn] = [1, 2, 3].map((k) => Math.sin(12.9898 * (number + 1) * k));
  const points = [];
  const faces = [];
  for (let i = 0; i < 64; i += 1) {
    const [x, y, z] = [i % 4, Math.floor(i / 4) % 4, Math.floor(i / 16)];
    const [u, v] = [(x - 1.5) * (10 + wide), (y - 1.5) * (10 + tall)];
    const angle = 0.2 * turn;
    points.push([
      u * Math.cos(angle) - v * Math.sin(angle) + 5 * turn,
      u * Math.sin(angle) + v * Math.cos(angle),
      (z - 1.5) * (10 + wide * tall) + Math.sin(number * 7 + i),
    ]);
    if (x < 3 && y < 3) faces.push([i, i + 1, i + 4], [i + 1, i + 5, i + 4]);
  }
  const lines = [
    "ply",
    "format ascii 1.0",
    `element vertex ${points.length}`,
    ...["x", "y", "z"].map((axis) => `property float ${axis}`),
    `element face ${faces.length}`,
    "property list uchar int vertex_indices",
    "end_header",
    ...points.map((point) => point.map((value) => value.toFixed(5)).join(" ")),
    ...faces.map((face) => `3 ${face.join(" ")}`),
  ];
  return Buffer.from(`${lines.join("\n")}\n`);
}

/** A folder of so many of them. */
export const meshes = (folder, first, count) =>
  Array.from({ length: count }, (_, i) => ({
    name: `${folder}/${String(i + 1).padStart(2, "0")}.ply`,
    bytes: mesh(first + i),
  }));

/** Normal numbers that are the same on every machine. */
function normalNumbers(seed) {
  let state = seed;
  const uniform = () => {
    // Mulberry32.
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
  return () => Math.sqrt(-2 * Math.log(1 - uniform())) * Math.cos(2 * Math.PI * uniform());
}

/** A bent sheet of 5 × 4 points: four ways to vary by `deviations`, noise of 0.2, and a bulge in the middle. */
function sheet(normal, deviations, bulge) {
  const ways = deviations.map((deviation) => deviation * normal());
  const lines = [];
  for (let i = 0; i < 20; i += 1) {
    const [u, v] = [(i % 5) / 4, Math.floor(i / 5) / 3];
    const [round, wave] = [
      Math.sin(Math.PI * u) * Math.sin(Math.PI * v),
      Math.sin(2 * Math.PI * u),
    ];
    const height =
      ways[0] * wave +
      ways[1] * Math.sin(2 * Math.PI * v) +
      ways[2] * Math.cos(3 * Math.PI * u * v);
    const point = [40 * u + ways[3] * wave * v, 30 * v, 8 * round + height + bulge * round ** 2];
    lines.push(`v ${point.map((value) => (value + 0.2 * normal()).toFixed(5)).join(" ")}`);
  }
  for (let i = 0; i < 14; i += 1) {
    if (i % 5 < 4) lines.push(`f ${i + 1} ${i + 2} ${i + 6}`, `f ${i + 2} ${i + 7} ${i + 6}`);
  }
  return Buffer.from(`${lines.join("\n")}\n`);
}

/** A folder of `count` independent shapes of a population with a known law: of one population, unless `other`. */
export function sample(folder, seed, count, other = false) {
  const normal = normalNumbers(seed);
  const deviations = other ? [0.6, 2.5, 1.5, 0.8] : [2.5, 1.5, 1, 0.6];
  return Array.from({ length: count }, (_, i) => ({
    name: `${folder}/${String(i + 1).padStart(2, "0")}.obj`,
    bytes: sheet(normal, deviations, other ? 9 : 0),
  }));
}
