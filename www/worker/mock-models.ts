/** Development only: models for the mock engine, read from the packaged heads or invented. */

export interface MockModel {
  name: string;
  format: string;
  dimension: 2 | 3;
  unit: string;
  mean: Float32Array;
  /** One array per mode, scaled by its standard deviation. */
  modes: Float32Array[];
  triangles: Uint32Array | null;
  segments: Uint32Array | null;
}

const HEADS = ["male", "female", "identity", "expression"] as const;

export async function packagedHeads(base: string): Promise<Map<string, MockModel>> {
  const models = new Map<string, MockModel>();
  for (const head of HEADS) {
    const name = `heads-${head}`;
    const response = await fetch(new URL(`demos/${name}.npz`, base)).catch(() => null);
    models.set(name, response?.ok ? await headFrom(name, await response.arrayBuffer()) : egg(name));
  }
  return models;
}

async function headFrom(name: string, bytes: ArrayBuffer): Promise<MockModel> {
  const members = await unzip(bytes);
  const raw = (member: string) => {
    const data = members.get(`${member}.npy`) ?? new ArrayBuffer(0);
    return data.slice(10 + new DataView(data).getUint16(8, true));
  };
  const mean = new Float32Array(raw("mean"));
  const basis = new Int16Array(raw("basis"));
  const scale = new Float32Array(raw("basis_scale"));
  const modes = Array.from(scale, (factor, mode) =>
    Float32Array.from(
      basis.subarray(mode * mean.length, (mode + 1) * mean.length),
      (v) => v * factor,
    ),
  );
  const faces = new Uint16Array(raw("faces"));
  const triangles = new Uint32Array(faces.length);
  const count = faces.length / 3;
  // Fortran order: all first corners, then all second ones.
  for (let i = 0; i < count; i += 1) {
    for (let corner = 0; corner < 3; corner += 1) {
      triangles[3 * i + corner] = faces[corner * count + i] ?? 0;
    }
  }
  return model(name, "packaged head (mock)", 3, "mm", mean, modes, triangles, null);
}

async function unzip(bytes: ArrayBuffer): Promise<Map<string, ArrayBuffer>> {
  const view = new DataView(bytes);
  const members = new Map<string, ArrayBuffer>();
  let end = bytes.byteLength - 22;
  while (view.getUint32(end, true) !== 0x06054b50) end -= 1;
  let at = view.getUint32(end + 16, true);
  for (let i = view.getUint16(end + 10, true); i > 0; i -= 1) {
    const size = view.getUint32(at + 20, true);
    const nameLength = view.getUint16(at + 28, true);
    const skip = view.getUint16(at + 30, true) + view.getUint16(at + 32, true);
    const local = view.getUint32(at + 42, true);
    const name = new TextDecoder().decode(new Uint8Array(bytes, at + 46, nameLength));
    const from = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
    const packed = new Blob([bytes.slice(from, from + size)]);
    const stream = packed.stream().pipeThrough(new DecompressionStream("deflate-raw"));
    members.set(name, await new Response(stream).arrayBuffer());
    at += 46 + nameLength + skip;
  }
  return members;
}

/** An ellipsoid, for when the heads are not there. */
function egg(name: string): MockModel {
  const rows = 40;
  const columns = 60;
  const mean = new Float32Array((rows + 1) * columns * 3);
  const radial = new Float32Array(mean.length);
  const tall = new Float32Array(mean.length);
  const triangles: number[] = [];
  for (let row = 0; row <= rows; row += 1) {
    const polar = Math.PI * (0.01 + (0.9 * row) / rows);
    for (let column = 0; column < columns; column += 1) {
      const turn = (2 * Math.PI * column) / columns;
      const at = 3 * (row * columns + column);
      const unit = [
        Math.sin(polar) * Math.sin(turn),
        Math.cos(polar),
        Math.sin(polar) * Math.cos(turn),
      ];
      unit.forEach((value, axis) => {
        mean[at + axis] = value * ([78, 120, 95][axis] ?? 1);
        radial[at + axis] = axis === 1 ? 0 : value * 4;
        tall[at + axis] = axis === 1 ? value * 6 : 0;
      });
      const right = row * columns + ((column + 1) % columns);
      if (row < rows) {
        const here = row * columns + column;
        triangles.push(here, here + columns, right, right, here + columns, right + columns);
      }
    }
  }
  return model(name, "invented", 3, "mm", mean, [radial, tall], Uint32Array.from(triangles), null);
}

/** A star whose spikes grow and shrink. */
export function star(name: string, firstSpike: number): MockModel {
  const points = 120;
  const mean = new Float32Array(2 * points);
  const modes = [0, 1, 2].map(() => new Float32Array(2 * points));
  const segments = new Uint32Array(2 * points);
  for (let i = 0; i < points; i += 1) {
    const turn = (2 * Math.PI * i) / points;
    mean[2 * i] = Math.cos(turn);
    mean[2 * i + 1] = Math.sin(turn);
    segments.set([i, (i + 1) % points], 2 * i);
    modes.forEach((mode, k) => {
      const centre = (2 * Math.PI * (k + firstSpike)) / 5 + Math.PI / 2;
      const height = 0.22 * Math.exp(-(((Math.cos(turn - centre) - 1) / 0.02) ** 2));
      mode[2 * i] = height * Math.cos(turn);
      mode[2 * i + 1] = height * Math.sin(turn);
    });
  }
  return model(name, "the paper's stars (mock)", 2, "units", mean, modes, null, segments);
}

/** The model on some of its points; null takes all. */
export function selected(whole: MockModel, points: number[] | null): MockModel {
  if (points === null) return whole;
  const { dimension } = whole;
  const places = new Map(points.map((point, place) => [point, place]));
  const pick = (values: Float32Array) =>
    Float32Array.from({ length: points.length * dimension }, (_, i) => {
      const point = points[Math.floor(i / dimension)] ?? 0;
      return values[point * dimension + (i % dimension)] ?? 0;
    });
  const cells = (all: Uint32Array | null, corners: number) => {
    if (all === null) return null;
    const kept: number[] = [];
    for (let i = 0; i < all.length; i += corners) {
      const cell = [...all.subarray(i, i + corners)].flatMap((point) => places.get(point) ?? []);
      if (cell.length === corners) kept.push(...cell);
    }
    return kept.length > 0 ? Uint32Array.from(kept) : null;
  };
  return {
    ...whole,
    mean: pick(whole.mean),
    modes: whole.modes.map(pick),
    triangles: cells(whole.triangles, 3),
    segments: cells(whole.segments, 2),
  };
}

/** A single point that moves in a plane. */
export function plane(name: string, tilt: number): MockModel {
  const modes = [
    Float32Array.from([2, 0, 0]),
    Float32Array.from([0, Math.cos(tilt), Math.sin(tilt)]),
  ];
  return model(name, "a plane in space (mock)", 3, "units", new Float32Array(3), modes, null, null);
}

function model(
  name: string,
  format: string,
  dimension: 2 | 3,
  unit: string,
  mean: Float32Array,
  modes: Float32Array[],
  triangles: Uint32Array | null,
  segments: Uint32Array | null,
): MockModel {
  return { name, format, dimension, unit, mean, modes, triangles, segments };
}
