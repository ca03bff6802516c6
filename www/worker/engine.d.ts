// Written by `SHAPEVENN_WRITE=1 npm run build` from src/wasm.rs.
import type {
    Axes, AxesKind, ChainPlots, DifferenceShapes, Download, DroppedFile, Ellipsoid, Evaluation, Explored, Geometry,
    Group, Inspection, LessonAnswer, LessonAsk, MapName, Nearest, OpenedModel, Pairing, PairPlots, PointSelection, Preview,
    Progress, Region, RegionShapes, RelationReport, RunFile, Settings, Side, Sides, Space, SweepPoint, VertexMap,
} from "./protocol";



/**
 * Models by handle and the current comparison.
 */
export class Engine {
    free(): void;
    [Symbol.dispose](): void;
    /**
     * Takes shapes of files as training or test shapes of a model, whichever they are; `name` is what they are called.
     *
     * # Errors
     * `{ code, message, hint }` when they cannot be read or do not fit; the model then stays as it was.
     */
    addShapes(model: number, files: DroppedFile[], name: string, reading: string): OpenedModel;
    /**
     * Does about `evaluations` evaluations of the distance and says how far the run is.
     *
     * # Errors
     * `{ code, message, hint }` when the run cannot go on.
     */
    advance(evaluations: number): Progress;
    /**
     * The axes of a space ("a", "b", "intersection") of a kind ("modes", "exclusive", "relative", "angles"):
     * `{ space, kind, values, reach, residual, noise }`.
     *
     * # Errors
     * `{ code, message, hint }` when no comparison is open, or the space has no such axes (yet).
     */
    axes(space: Space, kind: AxesKind): Axes;
    /**
     * Ends the run with what was drawn so far; afterwards there is a report.
     *
     * # Errors
     * `{ code, message, hint }` when there is nothing to report.
     */
    cancel(): void;
    /**
     * Forgets a model. A comparison that uses it keeps its own copy.
     */
    close(model: number): void;
    /**
     * How the two models of the comparison are drawn as it compares them: `{ a, b }`, geometries.
     *
     * # Errors
     * `{ code, message, hint }` when no comparison is open.
     */
    compared(): Sides<Geometry>;
    /**
     * What the chains of a side ("a", "b") did with one coefficient, from 0: `{ chains, length, every,
     * draws, distances, bins, ranks, autocorrelation }`.
     *
     * # Errors
     * `{ code, message, hint }` when there are no draws, or no such mode.
     */
    diagnose(side: Side, mode: number): ChainPlots;
    /**
     * The shape of least change from the one with these coefficients (in modes) whose point `vertex` is at
     * `target`, as [`Engine::explore`] gives it.
     *
     * # Errors
     * `{ code, message, hint }` when no comparison is open, or there is no such point.
     */
    drag(space: Space, coefficients: Float64Array | number[], vertex: number, target: Float64Array | number[], follow: boolean): Explored;
    /**
     * The covariance of a vertex in every region that there is: `{ a: { centre, axes }, … }`, the semi-axes one
     * after the other, longest first.
     *
     * # Errors
     * `{ code, message, hint }` when no comparison is open, or there is no such vertex.
     */
    ellipsoids(vertex: number): Partial<Record<Region, Ellipsoid>>;
    /**
     * Generalization and specificity of a model, by shapes that test it (`[{ name, blob }]`) or by those
     * that it was made of (`training`); `placement` says how test shapes are placed.
     *
     * # Errors
     * `{ code, message, hint }` when the shapes cannot be read or are not like those of the model.
     */
    evaluate(model: number, shapes: DroppedFile[], training: boolean, placement: Placement): Evaluation;
    /**
     * The shape at slider values along the axes: `{ shape, coefficients, norm, plausibility, nearest }`. With
     * `follow`, `nearest` has the nearest shapes `{ a, b }`, each `{ shape, residuals, distance, norm,
     * plausibility, likelihood }`; else it is null.
     *
     * # Errors
     * As [`Engine::axes`].
     */
    explore(space: Space, kind: AxesKind, coefficients: Float64Array | number[], follow: boolean): Explored;
    /**
     * A file to be saved: `{ name, mime, bytes }`.
     *
     * # Errors
     * `{ code, message, hint }` while there is nothing to save.
     */
    export(what: Download): { name: string; mime: string; bytes: Uint8Array };
    /**
     * A seed that nobody has had before, decimal.
     */
    static freshSeed(): string;
    /**
     * How a model is drawn: `{ dimension, kind, mean, triangles, segments, vertexSd }`.
     *
     * # Errors
     * `{ code, message, hint }` when the model is closed.
     */
    geometry(model: number): Geometry;
    /**
     * Which of the dropped files make a model together: `[{ name, files: [index] }]`. `files` is
     * an array of `{ name, blob }`.
     *
     * # Errors
     * `{ code, message, hint }`.
     */
    groups(files: DroppedFile[]): Group[];
    /**
     * Whether two models can be compared with these settings, and what would help.
     *
     * # Errors
     * `{ code, message, hint }` when a model is closed.
     */
    inspect(a: number, b: number, settings: Partial<Settings>): Inspection;
    /**
     * Answers one question of a lesson, `{ ask: "open" | "point" | …, … }`, in the types of
     * [`LessonAsk`] and [`crate::lessons::LessonAnswer`].
     *
     * # Errors
     * `{ code, message, hint }` when a value is out of its range, or there is nothing yet of what is asked
     * for.
     */
    lesson(ask: LessonAsk): LessonAnswer;
    /**
     * A map over the vertices of a region: `{ values, signed }`. `mode` counts from 0.
     *
     * # Errors
     * `{ code, message, hint }` while there is nothing of the region, or where the map needs normals and there
     * are none.
     */
    map(name: MapName, region: Region, mode: number): VertexMap;
    /**
     * Where a shape (d·n, in the frame of A) lies: its nearest shapes `{ a, b }`.
     *
     * # Errors
     * `{ code, message, hint }` when no comparison is open, or it has another number of points.
     */
    nearestShapes(shape: Float32Array | number[]): Sides<Nearest>;
    /**
     * An engine without models.
     */
    constructor();
    /**
     * Opens a demo model; `bytes` is its packaged file where it is one.
     *
     * # Errors
     * `{ code, message, hint }`.
     */
    openDemo(demo: string, bytes?: Uint8Array | number[] | null): OpenedModel;
    /**
     * Opens the model that files make together: `{ format, parts, model, part, report, origin, hasMap }`.
     * `onRead(bytes, of)` is told of everything that is read from them.
     *
     * # Errors
     * `{ code, message, hint }`.
     */
    open(files: DroppedFile[], part: string | null | undefined, reading: string, on_read: (bytes: number, of: number) => void): OpenedModel;
    /**
     * The shape of a side ("a", "b") at a place in the order of distances, 0 to 1, and the nearest of the other model.
     *
     * # Errors
     * `{ code, message, hint }` when no comparison is open.
     */
    pairing(side: Side, place: number): Pairing;
    /**
     * At most `most` draws of the first `modes` coefficients of a side, and the Gaussians beside them:
     * `{ modes, count, draws, mean, covariance, fit }`.
     *
     * # Errors
     * `{ code, message, hint }` when there are no draws.
     */
    pairs(side: Side, modes: number, most: number): PairPlots;
    /**
     * The choice of points that a vertex list or a file of pairs makes.
     *
     * # Errors
     * `{ code, message, hint }` when a line is none.
     */
    points(text: string): PointSelection;
    /**
     * The intersection at another σ, by the Gaussian fit alone: `{ prediction, shapes }`.
     *
     * # Errors
     * `{ code, message, hint }` when no comparison is open, or the fit breaks down.
     */
    preview(sigma: number, count: number, seed: string): Preview;
    /**
     * What is in the text of a run file or of a report: `{ models, settings }`.
     *
     * # Errors
     * `{ code, message, hint }` when it is neither.
     */
    readRun(text: string): RunFile;
    /**
     * Shapes of a region: `{ region, mean, vertexSd, samples, count, source }`. For the differences,
     * `exaggeration` is γ in x + γ r(a) and `picture` either "draws" or "exclusiveModes".
     *
     * # Errors
     * `{ code, message, hint }` while there is nothing of it.
     */
    region(region: Region, count: number, seed: string, exaggeration: number, picture: DifferenceShapes): RegionShapes;
    /**
     * Closed-form measures of two models, without draws: `{ problem, points, varianceOfAInB, … }`.
     *
     * # Errors
     * `{ code, message, hint }` when a model is closed or the settings cannot be read.
     */
    relate(a: number, b: number, settings: Partial<Settings>): RelationReport;
    /**
     * The report as JSON text, with the seconds that the worker's clock measured.
     *
     * # Errors
     * `{ code, message, hint }` while there is none.
     */
    report(total: number, sample: number, load?: number | null): string;
    /**
     * Puts back a finished run from its report and draws.
     *
     * # Errors
     * `{ code, message, hint }` when they do not belong to the two models.
     */
    restore(a: number, b: number, report: string, draws: Uint8Array | number[]): void;
    /**
     * The text of the run file of the comparison; `{ a, b }` say where the models are from.
     *
     * # Errors
     * `{ code, message, hint }` when no comparison is open.
     */
    runFile(sources: Sides<string | null>): string;
    /**
     * The table of the specimens in files of a set: `{ dimension, points, specimens, columns }`.
     *
     * # Errors
     * `{ code, message, hint }`.
     */
    specimens(files: DroppedFile[], reading: string): SpecimenTable;
    /**
     * Begins the comparison of two models; the one before it is given up. A setting that is left out
     * has the default of the sampler.
     *
     * # Errors
     * `{ code, message, hint }` when the two cannot be compared; the comparison before stays.
     */
    start(a: number, b: number, settings: Partial<Settings>): void;
    /**
     * What the fit says of the intersection at each σ: an array of predictions with distances.
     *
     * # Errors
     * `{ code, message, hint }` when no comparison is open.
     */
    sweep(sigmas: Float64Array | number[]): SweepPoint[];
    /**
     * The engine's version.
     */
    static version(): string;
}
