/**
 * Development only (`?mock`): an engine that invents its numbers and is slow on purpose, so that
 * loading, running, cancelling and failing can be seen without the real one.
 */
import { mockExploring } from "./mock-exploring";
import { type MockModel, packagedHeads, plane, selected, star } from "./mock-models";
import { comparedPoints, mockInspection, mockPoints } from "./mock-pair";
import { mockPrediction, mockReport, mockReportOf, mockSweepPoint } from "./mock-report";
import type {
  DroppedFile,
  Engine,
  EngineError,
  ExportKind,
  FileGroup,
  Geometry,
  Handle,
  OpenedModel,
  Origin,
  Progress,
  Region,
  RegionShapes,
  Settings,
  Stage,
} from "./protocol";

const RUN_EVALUATIONS = 16_000;

export async function mockEngine(base: string): Promise<Engine> {
  const heads = await packagedHeads(base);
  const models = new Map<Handle, MockModel>();
  let next: Handle = 1;
  let pair: { a: MockModel; b: MockModel; settings: Partial<Settings> } | null = null;
  let done = 0;

  const keep = (model: MockModel, more: Partial<OpenedModel> = {}): OpenedModel => {
    models.set(next, model);
    next += 1;
    return {
      format: model.format,
      parts: ["shape"],
      model: next - 1,
      part: "shape",
      report: mockReportOf(model),
      origin: { kind: "file" },
      hasMap: false,
      ...more,
    };
  };
  const find = (handle: Handle) => models.get(handle) ?? fail("handle", "No such model.", "");
  const current = () => pair ?? fail("no-run", "There is no run.", "Start one.");

  return {
    groups(files) {
      work(100);
      return grouped(files);
    },
    open(files, part, scale, onRead) {
      const name = files.length > 1 ? folderOf(files[0]?.name ?? "") : (files[0]?.name ?? "");
      read(name, onRead);
      if (name.endsWith(".txt")) {
        fail(
          "unknown-format",
          `“${name}” is not a shape model that Shapevenn can read.`,
          "Open a statismo or Scalismo .h5, a .mat, .npz or .pkl model.",
        );
      }
      const parts = /parts|bfm/.test(name) ? ["shape", "expression"] : ["shape"];
      const which = part ?? "shape";
      const base = heads.get(
        which === "expression" ? "heads-expression" : "heads-identity",
      ) as MockModel;
      const named = { ...base, name, format: "HDF5, Scalismo model" };
      const model = name.includes("crop")
        ? selected(named, [...base.mean.keys()].slice(0, 900))
        : named;
      const origin: Origin =
        files.length > 1
          ? { kind: "shapes", count: files.length, scaled: scale }
          : name.includes("blend")
            ? { kind: "blendshapes", count: 52, sampled: 1000 }
            : { kind: "file" };
      const opened = keep(model, { parts, part: which, origin, hasMap: name.includes("crop") });
      const { report } = opened;
      return name.includes("plain")
        ? {
            ...opened,
            report: {
              ...report,
              unit: "units",
              unitGuess: "mm",
              orthogonality: 0.02,
              droppedModes: 2,
            },
          }
        : opened;
    },
    openDemo(demo) {
      work(120);
      if (demo.startsWith("stars")) return keep(star(demo, demo.endsWith("a") ? 0 : 1));
      if (demo.startsWith("planes")) return keep(plane(demo, demo.endsWith("a") ? 0 : 1));
      return keep(heads.get(demo) ?? fail("demo", `There is no demo “${demo}”.`, ""));
    },
    geometry: (handle) => geometryOf(find(handle)),
    inspect(a, b, settings) {
      work(30);
      return mockInspection(find(a), find(b), settings);
    },
    points: mockPoints,
    compared() {
      const { a, b } = current();
      return { a: geometryOf(a), b: geometryOf(b) };
    },
    start(a, b, settings) {
      const points = comparedPoints(find(a), settings);
      const [first, second] = [selected(find(a), points), selected(find(b), points)];
      if (first.mean.length !== second.mean.length) {
        fail(
          "point-count-mismatch",
          `A has ${first.mean.length / first.dimension} points, B has ${second.mean.length / second.dimension}.`,
          "Load models built on the same template.",
        );
      }
      pair = { a: first, b: second, settings };
      done = 0;
    },
    advance(evaluations): Progress {
      work(Math.min(evaluations, 400) * 0.8);
      done += Math.min(evaluations, 400);
      const fraction = Math.min(1, done / RUN_EVALUATIONS);
      return {
        stage: stageAt(fraction),
        fraction,
        evaluations: done,
        draws: Math.round(8000 * fraction),
        acceptance: fraction > 0.05 ? 0.83 + 0.02 * Math.sin(done) : null,
        rHatMax: fraction > 0.1 ? 1 + 0.004 / fraction : null,
        essBulkMin: fraction > 0.1 ? 7600 * fraction : null,
        sigma: fraction > 0.02 ? 0.61 : null,
        hasIntersection: fraction > 0.04,
      };
    },
    cancel() {},
    report(total, sample) {
      const { a, b, settings } = current();
      return JSON.stringify(mockReport(a, b, settings, { load: 0.1, prepare: 0.4, sample, total }));
    },
    restore(a, b) {
      work(150);
      pair = { a: find(a), b: find(b), settings: {} };
    },
    region(region, count, seed, exaggeration, picture) {
      work(20);
      const { a, b } = current();
      const shapes = shapesOf(region, a, b, count, Number(seed), 0.45);
      if (region !== "aWithoutB" && region !== "bWithoutA") return shapes;
      const own = region === "aWithoutB" ? a : b;
      if (picture === "exclusiveModes") return exclusiveOf(shapes, own, 1 + exaggeration);
      return pushed(shapes, own, 1 + exaggeration);
    },
    preview(sigma, count, seed) {
      work(60);
      const { a, b } = current();
      const spread = mockSweepPoint(sigma).vertexSd / 3;
      const shapes = shapesOf("intersection", a, b, count, Number(seed), spread);
      return { prediction: mockPrediction(sigma), shapes: { ...shapes, source: "fit" } };
    },
    sweep(sigmas) {
      work(120 * sigmas.length);
      return Array.from(sigmas, mockSweepPoint);
    },
    export(what: ExportKind) {
      const text = what.kind === "report-json" ? "{}" : `mock ${what.kind}`;
      return {
        name: `${what.kind}.txt`,
        mime: "text/plain",
        bytes: new TextEncoder().encode(text),
      };
    },
    ...mockExploring,
    close: (handle) => {
      models.delete(handle);
    },
  };
}

function geometryOf({ dimension, mean, triangles, segments, modes }: MockModel): Geometry {
  return {
    dimension,
    kind: "shape",
    mean: mean.slice(),
    triangles: triangles?.slice() ?? null,
    segments: segments?.slice() ?? null,
    vertexSd: deviation(modes, dimension, 1),
  };
}

/** Meshes of one folder belong together. */
function grouped(files: DroppedFile[]): FileGroup[] {
  const groups = new Map<string, number[]>();
  files.forEach(({ name }, i) => {
    const key = /\.(ply|obj|stl|vtk)$/.test(name) ? folderOf(name) : name;
    groups.set(key, [...(groups.get(key) ?? []), i]);
  });
  return [...groups].map(([name, indices]) => ({ name, files: indices }));
}

function folderOf(name: string): string {
  return name.split("/").slice(0, -1).join("/") || "shapes";
}

/** Names that say “big” are read slowly. */
function read(name: string, onRead: (bytes: number, of: number) => void): void {
  const of = name.includes("big") ? 317e6 : 2e5;
  const steps = name.includes("big") ? 60 : 3;
  for (let step = 1; step <= steps; step += 1) {
    work(50);
    onRead((of * step) / steps, of);
  }
  work(name.includes("big") ? 1500 : 100);
}

function stageAt(fraction: number): Stage {
  if (fraction >= 1) return "done";
  if (fraction < 0.02) return "prepare";
  if (fraction < 0.05) return "fit";
  if (fraction < 0.7) return "intersection";
  return fraction < 0.97 ? "differences" : "measure";
}

function shapesOf(
  region: Region,
  a: MockModel,
  b: MockModel,
  count: number,
  seed: number,
  spread: number,
): RegionShapes {
  const own = region === "b" || region === "bWithoutA" ? b : a;
  const shared = region === "intersection";
  const mean = shared
    ? own.mean.map((value, i) => value + (1 - spread) * ((b.mean[i] ?? 0) - value))
    : own.mean.slice();
  const factor = shared ? spread : 1;
  const samples = new Float32Array(count * mean.length);
  const random = mulberry(seed * 7919 + region.length);
  for (let i = 0; i < count; i += 1) {
    const shape = samples.subarray(i * mean.length, (i + 1) * mean.length);
    shape.set(mean);
    for (const mode of own.modes) {
      const z = factor * normal(random);
      for (let k = 0; k < shape.length; k += 1) shape[k] = (shape[k] ?? 0) + z * (mode[k] ?? 0);
    }
  }
  const source = region === "a" || region === "b" ? "model" : "draws";
  return {
    region,
    mean,
    vertexSd: deviation(own.modes, own.dimension, factor),
    samples,
    count,
    source,
  };
}

/** Each shape further away from the mean. */
function pushed(shapes: RegionShapes, own: MockModel, factor: number): RegionShapes {
  const { length } = own.mean;
  const samples = shapes.samples.map((value, i) => {
    const mean = own.mean[i % length] ?? 0;
    return mean + factor * (value - mean);
  });
  return { ...shapes, samples };
}

function exclusiveOf(shapes: RegionShapes, own: MockModel, factor: number): RegionShapes {
  const { length } = own.mean;
  const modes = own.modes.slice(0, shapes.count);
  const samples = new Float32Array(modes.length * length);
  modes.forEach((mode, m) => {
    own.mean.forEach((value, i) => {
      samples[m * length + i] = value + 3 * factor * (mode[i] ?? 0);
    });
  });
  return { ...shapes, samples, count: modes.length };
}

export function deviation(modes: Float32Array[], dimension: number, factor: number): Float32Array {
  const points = (modes[0]?.length ?? 0) / dimension;
  return Float32Array.from({ length: points }, (_, point) => {
    let sum = 0;
    for (const mode of modes) {
      for (let axis = 0; axis < dimension; axis += 1)
        sum += (mode[point * dimension + axis] ?? 0) ** 2;
    }
    return factor * Math.sqrt(sum);
  });
}

function work(milliseconds: number): void {
  const until = performance.now() + milliseconds;
  while (performance.now() < until);
}

function mulberry(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

function normal(random: () => number): number {
  return Math.sqrt(-2 * Math.log(random() + 1e-12)) * Math.cos(2 * Math.PI * random());
}

function fail(code: string, message: string, hint: string): never {
  throw { code, message, hint } satisfies EngineError;
}
