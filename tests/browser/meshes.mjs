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
