// Written by `SHAPEVENN_WRITE=1 npm run test:rust -- typescript` from the types of the engine.

/** One of the two models of a comparison, or what belongs to it: shapes of A seen from B, and of B seen from A. */
export type Side = "a" | "b";

/** One of something for each of the two models. */
export type Sides<T> = {
  /** Of A, or of shapes of A near B. */
  a: T,
  /** Of B, or of shapes of B near A. */
  b: T,
};

/** Mean and covariance in some coordinates. In JSON both are lists, the covariance row by row. */
export type Moments = {
  /** Mean (p). */
  mean: Array<number>,
  /** Covariance (p × p). */
  covariance: Array<number>,
};

/** The unit of length in which a shape model is written. */
export type Unit = "µm" | "mm" | "cm" | "dm" | "m" | "units";

/** What the numbers of a model mean. */
export type Kind = "shape" | "color" | "displacement";

/** What may be moved when B is aligned to A. */
export type Alignment = "none" | "rigid" | "similarity";

/** Something that a person should know: a warning of a report, why two models cannot be compared, an error. */
export type Notice = {
  /** Stable code, for programs. */
  code: string,
  /** One sentence. */
  message: string,
  /** What to do next. */
  hint: string,
};

/** Something about a file that a person should look at, with what can be done. */
export type Finding = {
  /** Stable code, for programs. */
  code: string,
  /** One sentence or two: what was found, and what was done about it. */
  message: string,
  /** Whether the answer may be wrong if nothing is chosen; else the reader is sure. */
  doubt: boolean,
  /** Readings to choose from. */
  choices: Array<Choice>,
};

/** A reading that can be chosen. */
export type Choice = {
  /** A few words for a button. */
  label: string,
  /** The [`Reading`] as text. */
  reading: string,
};

/** Something that the reading says, with the reading that takes it back. */
export type Applied = {
  /** One sentence. */
  sentence: string,
  /** The [`Reading`] without it, as text. */
  undo: string,
};

/** How the intersection is sampled. */
export type Sampler = "auto" | "variational" | "independence" | "hmc" | "mala" | "pcn" | "paper" | "paper-corrected";

/** The method of a Gaussian fit. */
export type FitMethod = "rms" | "reweighted" | "variational" | "laplace";

/** Which Gaussian fit the samplers build on. */
export type FitChoice = "auto" | "variational" | "reweighted" | "laplace" | "rms";

/** Which of the two sides make the intersection model. */
export type Pooling = "both" | "a" | "b";

/** How the plausibility under A and that under B are put together. */
export type Plausibility = "product" | "idempotent";

/** What makes a shape of one model count as outside the other. */
export type DifferenceDefinition = "soft" | "distance" | "relative" | "outside";

/** Steps that concern one model. */
export type SidePreparation = {
  /** The unit that the file does not state. */
  unit: Unit | null,
  /** Use the first modes only. */
  modes: number | null,
  /** Use as many modes as hold this share of the variance, 0 to 1. */
  variance: number | null,
  /** Put the modes of this model on the mean of the other; displacements are added to it. */
  rebase: boolean,
};

/** Which point of B is which point of A. */
export type PointSelection = {
  "by": "region",
  /** Ranges of point numbers, ascending. */
  ranges: string,
} | {
  "by": "map"
} | {
  "by": "list",
  /** Points of A. */
  a: Array<number>,
  /** Points of B, as many. */
  b: Array<number>,
};

/** What is done to two models before they are compared. */
export type Preparation = {
  /** Steps that concern A alone. */
  a: SidePreparation,
  /** Steps that concern B alone. */
  b: SidePreparation,
  /** Whether B is scaled into the unit of A. */
  convert: boolean,
  /** Whether B is mirrored: x of every point and mode changes its sign. Alignment then brings it to A. */
  mirror: boolean,
  /** Which points are compared; all of them, in order, when left out. */
  points: PointSelection | null,
  /** Compare at most so many points. */
  subsample: number | null,
};

/** Settings as a user writes them; [`Settings::check`] makes them fit to run. */
export type Settings = {
  /**
   * Tolerance σ of the distance likelihood, in the unit of model A; `null` asks for the
   * recommended value. A report holds the value that was used.
   */
  sigma: number | null,
  /** Whether `sigma` is the recommended value, in the settings of a report or run file. */
  sigmaRecommended: boolean,
  /**
   * How far a true member of either population may lie from its own model, in the unit of A; `null`
   * where that is not known. The recommended σ and the question whether the models meet heed it.
   */
  noise: number | null,
  /** Seed of every random number, a decimal string (a JSON number cannot hold 64 bits). */
  seed: string,
  /** How the intersection is sampled. */
  sampler: Sampler,
  /** Which Gaussian fit the samplers build on. */
  fit: FitChoice,
  /** Which sides make the intersection model. */
  pooling: Pooling,
  /** How plausibility under A and under B are put together. */
  plausibility: Plausibility,
  /** Chains on each side. */
  chains: number,
  /** Draws kept on each side of the intersection, over all chains. */
  draws: number,
  /** Steps of each chain thrown away at its start. */
  burnIn: number,
  /** Steps of each chain kept for each draw handed on. */
  thin: number,
  /** Weighted draws on each side, with gradients, for the moments of the intersection. */
  weighted: number,
  /** What counts as a difference. */
  difference: DifferenceDefinition,
  /** Share of the model's own shapes that a hard difference leaves out, where no threshold is given. */
  differenceQuantile: number,
  /** Threshold of a hard difference, in the unit of its score; `null` takes the quantile. */
  differenceThreshold: number | null,
  /** Draws wanted of each difference. */
  differenceDraws: number,
  /** Random relabellings of the training shapes, which say what chance would give; 0 for no evidence. */
  permutations: number,
  /** Use only the first modes of each model; `null` uses all. */
  modes: number | null,
  /** What may be moved to bring B to A. */
  align: Alignment,
  /** What is done to the two models before they are compared. */
  prepare: Preparation,
};

/** Which values a setting may have, and how they are written. */
export type FieldValue = {
  "kind": "choice",
  /** The names. */
  of: Array<string>,
} | {
  "kind": "count",
  /** Smallest. */
  least: number,
  /** Largest. */
  most: number,
} | {
  "kind": "countOrAll",
  /** Smallest. */
  least: number,
  /** Largest. */
  most: number,
} | {
  "kind": "positive",
} | {
  "kind": "share",
} | {
  "kind": "seed"
};

/** A setting that can be given by name. */
export type Field = {
  /** Name in reports, run files and messages: a member of [`Settings`]. */
  name: Exclude<keyof Settings, "sigmaRecommended" | "prepare">,
  /** Key in a link. */
  key: string,
  /** Option on the command line, without its dashes. */
  option: string,
  /** What it is, in one line. */
  help: string,
  /** Which values it may have. */
  value: FieldValue,
  /** Whether every link has it, not only links in which it is not the default. */
  alwaysInLinks: boolean,
};

/** What a value may be. */
export type LinkValue = {
  "kind": "choice",
  /** The names. */
  of: Array<string>,
} | {
  "kind": "count",
  /** Smallest. */
  least: number,
  /** Largest. */
  most: number,
} | {
  "kind": "countOrAll",
  /** Smallest. */
  least: number,
  /** Largest. */
  most: number,
} | {
  "kind": "positive"
} | {
  "kind": "share"
} | {
  "kind": "shareOfVariance"
} | {
  "kind": "seed"
} | {
  "kind": "within",
  /** Smallest. */
  least: number,
  /** Largest. */
  most: number,
} | {
  "kind": "list",
  /** Smallest. */
  least: number,
  /** Largest. */
  most: number,
} | {
  "kind": "range"
} | {
  "kind": "camera"
} | {
  "kind": "points"
} | {
  "kind": "hash"
} | {
  "kind": "version"
} | {
  "kind": "address",
  /** Models that come with the page, named `demo:NAME`. */
  demos: Array<string>,
} | {
  "kind": "models",
  /** Their names. */
  of: Array<string>,
} | {
  "kind": "explorer"
} | {
  "kind": "text"
};

/** What a key of a link decides. */
export type LinkPart = "page" | "models" | "settings" | "view" | "lesson";

/** A key of a link. */
export type LinkKey = {
  /** The key. */
  key: string,
  /** What it decides. */
  part: LinkPart,
  /** What its value may be. */
  value: LinkValue,
  /** The same in words. */
  expected: string,
};

/** Files that make one model. */
export type Group = {
  /** What to call it: the file's name, or the folder's. */
  name: string,
  /** Which of the files of the drop. */
  files: Array<number>,
  /** Names of files beside a population that are left out: single shapes of another kind, files of no known format. */
  leftOut: Array<string>,
};

/** Where a model comes from. */
export type Origin = {
  "kind": "file"
} | {
  "kind": "shapes",
  /** How many shapes. */
  count: number,
  /** Whether they were brought to one size. */
  scaled: boolean,
} | {
  "kind": "blendshapes",
  /** How many displacements. */
  count: number,
  /** How many shapes were sampled. */
  sampled: number,
};

/** One specimen. */
export type SpecimenRow = {
  /** What a reading calls it (`without=`). */
  key: string,
  /** What a sentence calls it. */
  name: string,
  /** Centroid size: root of the sum of squared distances of its points from their centroid. `None` where one is missing. */
  size: number | null,
  /** Points that are missing. */
  missing: number,
  /** Whether the reading keeps it. */
  kept: boolean,
  /** What it has in each column; empty where nothing is known. */
  values: Array<string>,
};

/** What a column holds. */
export type ColumnKind = "groups" | "numbers" | "names";

/** A word of a column. */
export type ColumnValue = {
  /** The word. */
  word: string,
  /** Specimens that have it. */
  count: number,
};

/** One column. */
export type Column = {
  /** Its name. */
  name: string,
  /** What it holds. */
  kind: ColumnKind,
  /**
   * The different words or numbers, with how many specimens have each; of numbers, and of words that name the specimens,
   * none.
   */
  values: Array<ColumnValue>,
};

/** The specimens of a set, with what is known of each. */
export type SpecimenTable = {
  /** Coordinates per point. */
  dimension: number,
  /** Points of each. */
  points: number,
  /** In the order of the files. */
  specimens: Array<SpecimenRow>,
  /** What is known of them. */
  columns: Array<Column>,
};

/** Smallest, mean and largest of a map over the vertices. */
export type Spread = {
  /** Smallest value. */
  min: number,
  /** Mean over the vertices. */
  mean: number,
  /** Largest value. */
  max: number,
};

/** How shapes relate to the model that they are known with. */
export type ShapesRole = "training" | "within-modes" | "test";

/** Shapes that are known with a model. */
export type KnownShapes = {
  /** Number of shapes N. */
  count: number,
  /** How they relate to the model. */
  role: ShapesRole,
  /** What they are called, where they were given beside the model. */
  name: string | null,
  /**
   * [`TrainingShapes::fingerprint`](crate::model::TrainingShapes::fingerprint), where they were given beside the
   * model.
   */
  fingerprint: string | null,
};

/** One model, described. */
export type ModelReport = {
  /** What it is called: the file's name, with the part behind `#`. */
  name: string,
  /** File format, in words. */
  format: string,
  /** Shape or colour. */
  kind: Kind,
  /** Number of points n. */
  points: number,
  /** Coordinates per point d. */
  dimension: 2 | 3,
  /** Number of modes q. */
  modes: number,
  /** Unit of length. */
  unit: Unit,
  /** Σ λᵢ. */
  totalVariance: number,
  /** √λᵢ of the whole shape vector, largest first. */
  standardDeviations: Array<number>,
  /** Root mean square distance of the mean's points from their centroid. */
  size: number,
  /** Smallest, mean and largest per-vertex standard deviation. */
  vertexSd: Spread,
  /** Triangles, or line segments where there are no triangles. */
  cells: number,
  /** What reading the file brought to light, each a sentence. */
  notes: Array<string>,
  /** Largest |cos| between two modes of the file; 0 where they were orthogonal. */
  orthogonality?: number,
  /** Modes of the file that were dropped for lack of variance. */
  droppedModes?: number,
  /** The unit that the extent of the mean shape suggests, where the file states none. */
  unitGuess?: Unit,
  /** Which model of its file it is: "shape", "expression", a group's name. */
  part?: string,
  /** [`LinearModel::fingerprint`] of the model as it was read, before anything was done to it. */
  fingerprint?: string,
  /** The shapes that are known with it. */
  shapes?: KnownShapes,
  /** How it was read where its file does not say so: a [`Reading`] as text. */
  reading?: string,
  /** What the reading says, each with the reading that takes it back. */
  applied?: Array<Applied>,
  /** What a person should look at, with readings to choose from. */
  findings?: Array<Finding>,
};

/** What the page is told of a model that was opened; other parts are opened when they are chosen. */
export type OpenedModel = {
  /** File format, in words. */
  format: string,
  /** Names of all models of the file, the one to show first in front. */
  parts: Array<string>,
  /** What the page calls it by, until it is closed. */
  model: number,
  /** Which of `parts` it is. */
  part: string,
  /** Its description. */
  report: ModelReport,
  /** Where it comes from. */
  origin: Origin,
  /** Whether it says which points of a larger mesh its own are. */
  hasMap: boolean,
};

/** Mean shape, cells and variation of a model, as the page draws them. */
export type Geometry = {
  /** Coordinates per point d. */
  dimension: 2 | 3,
  /** What the coordinates are. */
  kind: Kind,
  /** Mean shape (d·n). */
  mean: Float32Array,
  /** Corners of the triangles, where there are some. */
  triangles: Uint32Array | null,
  /** Ends of the line segments, where there are some. */
  segments: Uint32Array | null,
  /** Standard deviation of every vertex, in the unit of the model (n). */
  vertexSd: Float32Array,
};

/** Whether two meshes have the same triangles. */
export type Agreement = "same" | "different" | "unknown";

/** A unit, stated and guessed. */
export type UnitFound = {
  /** By the file, or declared since. */
  stated: Unit,
  /** From the extent of the mean shape, where the file says nothing. */
  guess: Unit | null,
};

/** Mean distance of corresponding points of the two means, in the unit of A. */
export type MeanDistance = {
  /** As the files are. */
  before: number | null,
  /** As they would be compared now. */
  now: number | null,
  /** With B moved rigidly. */
  rigid: number | null,
  /** With B moved and brought to the size of A. */
  similarity: number | null,
  /** With the mirror image of B (of the mirrored B, B itself) moved rigidly. */
  mirrored: number | null,
};

/** One step that can be taken, or taken back. */
export type Remedy = {
  /** What it is about: "unit", "align" … */
  id: string,
  /** A few words for a button. */
  label: string,
  /** Why, in one sentence. */
  sentence: string,
  /** Settings to change; objects are merged. */
  settings: import("./protocol").SettingsPatch,
  /** Whether most people would want it. */
  recommended: boolean,
};

/** What there is to say about two models before they are compared. */
export type Inspection = {
  /** Why they cannot be compared as they stand. */
  problem: Notice | null,
  /** Points of each file. */
  points: Sides<number>,
  /** Points that would be compared. */
  compared: number | null,
  /** Whether the meshes agree. */
  triangles: Agreement,
  /** Units as stated, and as the extent of the mean suggests. */
  units: Sides<UnitFound>,
  /** How far apart the means are. */
  meanDistance: MeanDistance,
  /** Size of B over size of A, in the same unit where both are known. */
  scale: number | null,
  /** What would help. */
  remedies: Array<Remedy>,
  /** What was done already. */
  applied: Array<Remedy>,
};

/**
 * A relation as the page and `shapevenn matrix --json` have it: the reason instead of numbers where two models
 * cannot be compared.
 */
export type RelationReport = {
  /** Why the two cannot be compared with these settings. */
  problem: Notice | null,
  /** Points that are compared. */
  points: number,
  /** [`Relation::variance_of_a_in_b`]. */
  varianceOfAInB: number | null,
  /** [`Relation::variance_of_b_in_a`]. */
  varianceOfBInA: number | null,
  /** [`Relation::grassmann`]. */
  grassmann: number | null,
  /** [`Relation::grassmann_affine`]. */
  grassmannAffine: number | null,
  /** [`Relation::angles_degrees`]. */
  anglesDegrees: Array<number>,
  /** [`Relation::mean_to_mean`]. */
  meanToMean: number | null,
  /** [`Relation::bhattacharyya`]. */
  bhattacharyya: number | null,
  /** [`Relation::noise`]. */
  noise: number | null,
};

/** Whether the shapes are test shapes or training shapes. */
export type Method = "test" | "leave-one-out" | "folds";

/** How test shapes are placed. */
export type Placement = "given" | "mean" | "fit";

/** Generalization and specificity, for the first so many modes. */
export type Evaluation = {
  /** Number of shapes. */
  shapes: number,
  /** Whether they are test or training shapes. */
  method: Method,
  /** How many models were built for the cross-validation. */
  folds: number,
  /** How test shapes were placed before they were projected; those that are left out lie on the mean of the others. */
  placement: Placement,
  /** Numbers of modes. */
  modes: Array<number>,
  /** Mean distance of the shapes from their projection. */
  generalization: Array<number>,
  /** Its standard error. */
  generalizationError: Array<number>,
  /** Mean distance of random shapes from the nearest of the shapes. */
  specificity: Array<number>,
  /** Its standard error. */
  specificityError: Array<number>,
};

/** Where the σ of a run comes from. */
export type SigmaSource = "given" | "left-out" | "noise" | "budget" | "meeting";

/** Quantiles of a quantity over draws. */
export type Quantiles = {
  /** 5 %. */
  p05: number,
  /** Median. */
  p50: number,
  /** 95 %. */
  p95: number,
};

/** Mean squares per point, in closed form. `total` is the sum of the others. */
export type MeanSquare = {
  /** E‖r‖²/n. */
  total: number,
  /** Of the offset of the means, what no shape of the model closes. */
  offset: number,
  /** Of the offset, what some shape of the model closes. */
  offsetClosed: number,
  /** Of the variance of the model, what the other model cannot make. */
  exclusive: number,
};

/** Distance of the shapes of a model to the nearest plausible ones of the other, in the unit of the models. */
export type PlausibleDistance = {
  /** Mean over draws. */
  mean: number,
  /** Its Monte-Carlo standard error. */
  standardError: number,
};

/** How far the shapes of one model lie from the other. Lengths are in the unit of the models. */
export type ReachOfSide = {
  /** Mean distance of the shapes to the other model, over draws. */
  mean: number,
  /** Its Monte-Carlo standard error. */
  standardError: number,
  /** Quantiles of the distance. */
  quantiles: Quantiles,
  /** Their Monte-Carlo standard errors, from order statistics. */
  quantileErrors: Quantiles,
  /** Root mean square distance over that of the same shapes from their mean: what the other model leaves of them. */
  relative: number,
  /** What the mean square of the distances is made of. */
  meanSquare: MeanSquare,
  /** Distance to the nearest plausible shape of the other model, which is no nearer than the nearest of all. */
  plausible: PlausibleDistance | null,
};

/** Shares of the soft differences by σ, from the draws of the reach: E[1 − exp(−½(d/σ)²)]. */
export type ReachCurve = {
  /** σ, ascending in equal ratios. */
  sigma: Array<number>,
  /** P(A\B | σ). */
  aWithoutB: Array<number>,
  /** P(B\A | σ). */
  bWithoutA: Array<number>,
};

/** How far the shapes of each model lie from the other. Lengths are in the unit of A. */
export type ReachReport = {
  /** Of shapes of A to B. */
  aToB: ReachOfSide,
  /** Of shapes of B to A. */
  bToA: ReachOfSide,
  /**
   * Least distance of a plausible shape of A from a plausible shape of B (both within the 99 % ellipsoid); absent where
   * the two have such shapes in common.
   */
  meeting: number | null,
  /** Share of the shapes that count as outside the other model, for every σ. */
  curve: ReachCurve,
};

/** Counts of values in intervals of equal width. */
export type Histogram = {
  /** Where the first interval begins. */
  from: number,
  /** Where the last interval ends; that is where it begins when all values are the same. */
  to: number,
  /** Values in each interval. */
  counts: Array<number>,
};

/** A number under relabelling. */
export type Chance = {
  /** Mean. */
  mean: number,
  /** Standard deviation. */
  standardDeviation: number,
  /** 5 % quantile. */
  p05: number,
  /** 95 % quantile. */
  p95: number,
  /** How often it had which values. */
  histogram: Histogram,
};

/** What a statistic measures. */
export type StatisticName = "means" | "varianceAOutsideB" | "varianceBOutsideA" | "distanceAToB" | "distanceBToA" | "totalVariances" | "principalAngles";

/** A statistic; large values speak against the hypothesis. */
export type Statistic = {
  /** Which. */
  name: StatisticName,
  /** Its value. */
  observed: number,
  /** Its values under relabelling. */
  chance: Chance,
  /** Chance of a value as large under the hypothesis. */
  p: number,
  /** Standard error of p, for it is found by random relabellings. */
  pError: number,
  /** Adjusted for the number of statistics of the hypothesis (Holm). */
  pAdjusted: number,
};

/** A hypothesis with its statistics. */
export type Hypothesis = {
  /** Relabellings. */
  permutations: number,
  /** Whether these are all that are possible. */
  exhaustive: boolean,
  /** Its statistics. */
  statistics: Array<Statistic>,
};

/** One curve with what chance makes of it. */
export type Band = {
  /** Of the two groups. */
  observed: Array<number>,
  /** Mean under relabelling. */
  mean: Array<number>,
  /** 5 % quantile under relabelling. */
  p05: Array<number>,
  /** 95 % quantile under relabelling. */
  p95: Array<number>,
};

/** Curves over the modes, observed and of groups relabelled at random (one population). */
export type Bands = {
  /** Share of the variance of each inside the first k modes of the other, k = 1, 2, … */
  sharedVariance: Sides<Band>,
  /** Principal angles of the first modes, smallest first, in degrees. */
  principalAnglesDegrees: Band,
  /** Standard deviations of the modes, of the whole shape vector. */
  standardDeviations: Sides<Band>,
  /**
   * Exclusive modes: root mean square over the points of what one standard deviation of each leaves outside the
   * first modes of the other, largest first.
   */
  exclusiveModes: Sides<Band>,
};

/** Left-out errors of a group, mean over the points of each shape, in the unit of the shapes. */
export type LeftOut = {
  /** Mean over the shapes. */
  mean: number,
  /** Standard deviation over the shapes (divisor n − 1). */
  standardDeviation: number,
  /**
   * Share of the shapes that count as outside the model of the others at the σ of the comparison,
   * E[1 − exp(−½(d/σ)²)]: what the shares of the differences are to be seen beside. Absent without a σ, and where the
   * errors are zero.
   */
  beyondSigma: number | null,
};

/** Shares of variance at equal numbers of shapes: means over random parts of the larger group. */
export type MatchedShares = {
  /** Shapes of each group. */
  shapes: number,
  /** Share of A's variance outside the first modes of B. */
  varianceAOutsideB: number,
  /** Share of B's variance outside the first modes of A. */
  varianceBOutsideA: number,
};

/** How well shapes of a group are told from those of the other. */
export type ToldApart = {
  /**
   * Share of the group's shapes that are nearer to the model of its other shapes than to the other group's, by
   * the mean distance of the points; ties are half.
   */
  share: number,
  /** The same share of groups relabelled at random, by the root mean square distance of the points. */
  chance: Chance,
};

/** Where the means of the groups differ. */
export type VertexEvidence = {
  /** Family-wise p of every point: chance that, with no difference anywhere, any point would show as large a one. */
  p: Array<number>,
  /** Share of the points with p ≤ 0.05. */
  differ: number,
  /** Share of the points that are called different when a twentieth of those that are may be false. */
  falseDiscovery: number,
};

/** How alike the modes of random halves of a group are. */
export type ModeStability = {
  /** Mean squared cosine of the principal angles between the first k modes of two halves, k = 1, 2, … */
  overlap: Array<number>,
  /** The same between a half and the whole group: how far the modes of the group may be off. */
  withWhole: Array<number>,
  /** Dimensions r among which modes can turn: random spaces of k dimensions have an overlap of k/r. */
  dimensions: number,
  /** Number of modes up to which each adds more than half of a shared direction, chance deducted; at least one. */
  suggestedModes: number,
};

/** Whether two groups of shapes differ by more than chance, where, and how stable their modes are. */
export type EvidenceReport = {
  /** Numbers of shapes. */
  shapes: Sides<number>,
  /** How many shapes of A there are in B too. */
  sharedShapes: number,
  /** How many modes of each group the statistics compare. */
  modes: number,
  /** What the model of all other shapes of a group misses of each. */
  leftOut: Sides<LeftOut>,
  /** Relabellings that were compared with the observed labelling. */
  permutations: number,
  /** Whether both groups are of one population. */
  onePopulation: Hypothesis,
  /** Whether the populations vary alike about means that may differ. */
  oneCovariance: Hypothesis,
  /** What two random groups of these sizes would have. */
  bands: Bands,
  /** The shares of variance at equal numbers of shapes, where the groups have different ones. */
  matched?: MatchedShares,
  /** Whether shapes are nearer to the model of their own group. */
  toldApart: Sides<ToldApart>,
  /** Where the means differ. */
  vertices: VertexEvidence,
  /** How many modes of each group are more than an accident of who was measured. */
  stability: Sides<ModeStability>,
  /** What the reader should know before believing the numbers. */
  conditions: Array<Notice>,
};

/** What a sentence is about. */
export type Topic = "reach-of-a" | "reach-of-b" | "nearest-plausible" | "more-than-chance" | "no-more-than-chance" | "chance-unknown" | "told-apart-a" | "told-apart-b";

/** What a number is, which decides how it is written. */
export type Quantity = "length" | "length-without-unit" | "spread" | "share" | "count" | "p-value";

/** A model or its shapes, as a sentence names them. */
export type Name = "model-a" | "model-b" | "shape-of-a" | "shape-of-b" | "shapes-of-a" | "shapes-of-b";

/** A part of a sentence. */
export type Part = string | {
  /** Its path in the report, as `reach.aToB.mean`. */
  metric: string,
  /** Its value. */
  value: number,
  /** What kind of number it is. */
  quantity: Quantity,
} | {
  /** Which. */
  name: Name,
};

/** A sentence of the answer. */
export type Sentence = {
  /** What it is about. */
  about: Topic,
  /** Its words, numbers and names, in order; the first letter is made a capital. */
  parts: Array<Part>,
};

/** Mean and standard deviation of a quantity over draws. */
export type MeanSd = {
  /** Mean over the draws. */
  mean: number,
  /** Standard deviation over the draws (divisor N − 1). */
  sd: number,
};

/** Whether to believe a set of draws. */
export type Diagnostics = {
  /** Largest rank-normalised split R-hat over the coefficients; absent for independent draws. */
  rHatMax: number | null,
  /** Smallest bulk effective sample size. */
  essBulkMin: number,
  /** Smallest tail effective sample size. */
  essTailMin: number,
  /** Share of proposals accepted. */
  acceptance: number,
  /** Pareto shape of the importance weights; absent where there are none. */
  paretoK: number | null,
  /** Evaluations of the distance. */
  evaluations: number,
  /** Draws kept. */
  draws: number,
  /**
   * R-hat below 1.01 and at least 400 effective draws for every mode, or Pareto k below 0.7 and an
   * effective size of the weights above 1,000.
   */
  converged: boolean,
  /** Effective size of the importance weights; absent where there are none. */
  importanceEss: number | null,
  /** Largest Monte-Carlo standard error of a coefficient's mean. */
  mcseMean: number | null,
  /** Largest Monte-Carlo standard error of a coefficient's standard deviation. */
  mcseSd: number | null,
  /** Largest correlation of a coefficient with its next draw. */
  autocorrelation: number | null,
};

/** Diagnostics of each coefficient, first mode first. */
export type ModeDiagnostics = {
  /** Rank-normalised R-hat, the larger of split and folded. */
  rHat: Array<number>,
  /** Bulk effective sample size. */
  essBulk: Array<number>,
  /** Tail effective sample size. */
  essTail: Array<number>,
  /** Monte-Carlo standard error of the mean. */
  mcseMean: Array<number>,
  /** Monte-Carlo standard error of the standard deviation. */
  mcseSd: Array<number>,
  /** Correlation with the next draw. */
  autocorrelation: Array<number>,
};

/** What the moments of a side are made of. */
export type MomentSource = "closed-form" | "weighted" | "draws";

/** How one side was inferred. */
export type InferenceReport = {
  /** The sampler that ran. */
  sampler: Sampler,
  /** Why, in a sentence. */
  reason: string,
  /** The Gaussian fit that it builds on. */
  fit: FitMethod,
  /** What the moments are made of. */
  moments: MomentSource,
};

/** Standard errors of the intersection model. Modes are counted from 1 in words, from 0 in lists. */
export type Accuracy = {
  /** Of the covariance, as a share of it (Frobenius norm). */
  covariance: number,
  /** Of each standard deviation. */
  standardDeviations: Array<number>,
  /** Radians by which each mode may turn. */
  modeTurns: Array<number>,
  /** Predicted error of the Grassmann distance of the first k modes, k = 1, 2, … */
  grassmann: Array<number>,
  /** Leading modes that are determined one by one (turn below 0.2 radians). */
  modesTrusted: number,
};

/** How far the models that either side alone would give lie apart. */
export type Disagreement = {
  /** Mean distance between corresponding points of the two means. */
  meanToMean: number,
  /** Frobenius norm of the difference of the covariances, as a share of the pooled one's. */
  covariance: number,
  /** Share of the pooled variance that lies between the two means. */
  betweenShare: number,
  /** Σ λᵢ of either side's own law. */
  totalVariance: Sides<number>,
  /** Standard deviations of either side's own model. */
  standardDeviations: Sides<Array<number>>,
  /** Grassmann distance (the paper's) between the first 1, 3, 5 and 10 modes of the two. */
  grassmann: Array<number>,
};

/** σ beside the distances of the two models, in the unit of A. */
export type ToleranceReport = {
  /** The σ that would be recommended. */
  recommended: number,
  /** σ in use as a share of the size of A. */
  relative: number,
  /** Expected distance as σ → 0: how near the models come. */
  nearest: number,
  /** Expected distance as σ → ∞, where only plausibility acts. */
  farthest: number,
  /** E d at the σ in use by √(d(μ)² + q_eff σ²), averaged over the sides. */
  predicted: number,
  /** Dimensions on which the distance acts, q_eff = tr[Σ(Λ − I − AᵀA)], averaged over the sides. */
  effectiveDimensions: number,
  /** Least distance of a plausible shape of A from a plausible shape of B (both within the 99 % ellipsoid). */
  meeting: number | null,
  /** How far true members lie from their own model: as given, or from the modes that were cut off. */
  noise: number | null,
};

/** Distances of the intersection model to A, to B and to their union, in radians. */
export type Grassmann = {
  /** To model A. */
  toA: number,
  /** To model B. */
  toB: number,
  /** To the union model: the moment-matched equal mixture of A and B. */
  toUnion: number,
};

/** The intersection model and how far it may be believed. */
export type IntersectionReport = {
  /** Modes of the intersection model. */
  modes: number,
  /** √λᵢ of the intersection model, largest first. */
  standardDeviations: Array<number>,
  /** Σ λᵢ of the intersection model. */
  totalVariance: number,
  /** Share of the pooled draws' variance that its modes hold. */
  varianceKept: number,
  /** d(x′, x) over the draws of both sides. */
  meanDistance: MeanSd,
  /** Affine Grassmann distances as the paper computes them. */
  grassmann: Grassmann,
  /** Affine Grassmann distances as Lim, Wong and Ye define them. */
  grassmannAffine: Grassmann,
  /** Of both sides together: the worst of everything. */
  diagnostics: Diagnostics,
  /** Of the draws that start from A and from B. */
  sides: Sides<Diagnostics>,
  /** The same for each coefficient. */
  coefficients: Sides<ModeDiagnostics> | null,
  /** Of the per-vertex standard deviation of the intersection model. */
  vertexSd: Spread,
  /** Which sampler ran on each side, why, and what the moments come from. */
  inference: Sides<InferenceReport> | null,
  /** How far the model may be off; absent where its draws do not tell. */
  accuracy: Accuracy | null,
  /** What the two sides say apart from one another; absent when only one makes the model. */
  disagreement: Disagreement | null,
  /** σ against the distances of the two models. */
  tolerance: ToleranceReport | null,
};

/** What the proposals of a difference are drawn from. */
export type EnvelopeName = "prior" | "tilted";

/** Directions in which a model varies most and the other cannot follow. */
export type ExclusiveReport = {
  /** Residual (root mean square over the points) of one standard deviation along each, largest first. */
  residualSd: Array<number>,
  /** Share of the model's variance that the other cannot make. */
  unexplained: number,
};

/**
 * A model without the intersection as a matter of moments (Hall, Marshall & Martin's splitting), beside the
 * set difference.
 */
export type LinearSplitReport = {
  /** Share of the model that is taken for the intersection, 1 − P of the difference. */
  weight: number,
  /** Mean distance between corresponding points of the split's mean and that of the difference's draws. */
  meanToMean: number,
  /** Share of the split's variance that is negative: it need not be the covariance of anything. */
  negativeShare: number,
  /** Per-vertex standard deviation of the split without its negative part. */
  vertexSd: Spread,
  /** Total variance of the split without its negative part, as a share of that of the difference's draws. */
  varianceRatio: number,
};

/** One set difference, sampled exactly. */
export type DifferenceReport = {
  /** Share of the model's shapes that the other cannot make, E[1 − L_D]. */
  probability: number,
  /** Its Monte-Carlo standard error. */
  standardError: number,
  /** d(x′, x) over the draws. */
  meanDistance: MeanSd,
  /** Diagnostics of the rejection sampler. */
  diagnostics: Diagnostics,
  /** Of the per-vertex standard deviation over the draws. */
  vertexSd: Spread,
  /** What counts as a difference. */
  definition: DifferenceDefinition,
  /** σ of the soft difference, the threshold of the score of the others. */
  threshold: number | null,
  /** What the proposals were drawn from. */
  envelope: EnvelopeName,
  /**
   * Share that the law of the draws has in common with the model itself, 1 − TV: near 1, the difference
   * looks like the model.
   */
  overlapWithPrior: number,
  /** Its Monte-Carlo standard error. */
  overlapStandardError: number,
  /** What the other model lacks, mode by mode, without any draws. */
  exclusive: ExclusiveReport | null,
  /** The baseline by linear splitting; absent where nothing is left of the model, or nothing was drawn. */
  linearSplit: LinearSplitReport | null,
};

/** The two set differences. */
export type Differences = {
  /** A \ B. */
  aWithoutB: DifferenceReport,
  /** B \ A. */
  bWithoutA: DifferenceReport,
};

/** What is lost when one model is described by the other, in nats. */
export type KullbackLeibler = {
  /** KL(A‖B): shapes of A, described by B. */
  aFromB: number,
  /** KL(B‖A): shapes of B, described by A. */
  bFromA: number,
};

/** Shares of variance, principal angles and divergences of two models. */
export type Overlap = {
  /** Principal angles between span U₁ and span U₂, smallest first. */
  principalAnglesDegrees: Array<number>,
  /** Share of A's variance that lies in the space of B. */
  varianceOfAInB: number,
  /** Share of B's variance that lies in the space of A. */
  varianceOfBInA: number,
  /**
   * Bhattacharyya distance after adding noise of standard deviation `bhattacharyya_noise` to
   * every coordinate; it diverges as the noise goes to 0.
   */
  bhattacharyya: number,
  /** The noise: σ of the comparison, or a millionth of the largest standard deviation where σ is less. */
  bhattacharyyaNoise: number,
  /** Kullback–Leibler divergences with the same noise, which diverge like it. */
  kullbackLeibler: KullbackLeibler | null,
  /** Mean distance between corresponding points of the two mean shapes. */
  meanToMean: number,
};

/** How few modes hold how much of a model: the share of its variance in its first 1, 2, … modes. */
export type Compactness = {
  /** Of A. */
  a: Array<number>,
  /** Of B. */
  b: Array<number>,
  /** Of the intersection model. */
  intersection: Array<number>,
};

/** The two models of a comparison. */
export type Models = {
  /** First model. */
  a: ModelReport,
  /** Second model, after alignment and unit. */
  b: ModelReport,
};

/** Wall-clock seconds of the stages; the only part of a report that is not reproducible. */
export type Seconds = {
  /** Reading the two models. */
  load: number,
  /** Residual operator, σ and fits. */
  prepare: number,
  /** Drawing. */
  sample: number,
  /** From start to report. */
  total: number,
};

/** A finished (or cancelled) comparison of two models. */
export type Report = {
  /** [`SCHEMA`]. */
  schema: number,
  /** Version of the engine that made it. */
  engine: string,
  /** The two models. */
  models: Models,
  /** Everything needed to run again. */
  settings: Settings,
  /** Where the σ in `settings` comes from; reports of older engines do not say. */
  sigmaSource: SigmaSource | null,
  /** How far the shapes of one model lie from the other, without any tolerance. */
  reach: ReachReport | null,
  /** Whether the two populations differ by more than chance; absent where the shapes of one are not known. */
  evidence: EvidenceReport | null,
  /** The answer in words. */
  answer: Array<Sentence>,
  /** The allowable shapes of both. */
  intersection: IntersectionReport,
  /** The shapes of one that the other cannot make. */
  differences: Differences,
  /** Shares of variance, principal angles and divergences of the two models. */
  overlap: Overlap,
  /** How few modes hold how much of each model. */
  compactness: Compactness | null,
  /** What the reader should know before believing the numbers. */
  warnings: Array<Notice>,
  /** Wall-clock seconds. */
  seconds: Seconds,
};

/** Where a run is. */
export type Stage = "prepare" | "fit" | "intersection" | "differences" | "measure" | "evidence" | "done";

/** How far a run is. */
export type Progress = {
  /** Where the run is. */
  stage: Stage,
  /** Share of the whole run, 0 to 1. */
  fraction: number,
  /** Evaluations of the distance so far. */
  evaluations: number,
  /** Draws of the intersection kept so far, both sides. */
  draws: number,
  /** Share of proposals accepted, both sides; absent before there are any. */
  acceptance: number | null,
  /** Largest R-hat over the first coefficients of both sides. */
  rHatMax: number | null,
  /** Smallest bulk effective sample size over the first coefficients of both sides. */
  essBulkMin: number | null,
  /** σ in use, once it is known. */
  sigma: number | null,
  /** Whether there are shapes of the intersection to look at. */
  hasIntersection: boolean,
};

/** A region of the Venn diagram. */
export type Region = "a" | "aWithoutB" | "intersection" | "bWithoutA" | "b";

/** What the shapes of a region come from. */
export type ShapeSource = "model" | "fit" | "draws";

/** Which shapes of a difference are shown. */
export type DifferenceShapes = "draws" | "exclusiveModes";

/** Which shape a contrast pushes. */
export type ContrastOf = "mean" | "exclusive-mode";

/** A shape of a model, pushed away from the other model. */
export type Contrast = {
  /** The pushed shape (d·n). */
  shape: Float32Array,
  /** Which shape was pushed. */
  of: ContrastOf,
  /** How many times as far it lies from the other model as before, 1 + γ. */
  times: number,
  /** Mean distance of every vertex (n) of shapes of the model from the nearest that the other can make. */
  missed: Float32Array,
};

/** A shape of a model, and the nearest of the other. */
export type Pairing = {
  /** The shape (d·n), in the frame of A. */
  shape: Float32Array,
  /** The nearest shape of the other model (d·n). */
  nearest: Float32Array,
  /** Distance of every vertex (n) of the two. */
  missed: Float32Array,
  /** Its mean. */
  distance: number,
  /** Number of the shape among the known ones, from 1. */
  number: number,
  /** Its place in the order of distances, from 1. */
  rank: number,
  /** How many shapes there are. */
  count: number,
  /** Whether they are known shapes of the population, not random ones of the model. */
  known: boolean,
};

/** Mean, variation and some shapes of a region, in the frame and unit of A. */
export type RegionShapes = {
  /** Mean shape (d·n). */
  mean: Float32Array,
  /** Per-vertex standard deviation (n). */
  vertexSd: Float32Array,
  /** Shapes one after the other (count × d·n). */
  samples: Float32Array,
  /** Number of shapes; may be less than was asked for when there are no draws. */
  count: number,
  /** What they come from. */
  source: ShapeSource,
  /** Of a difference: the picture of what the other model misses, where it misses something. */
  contrast?: Contrast,
};

/** What a fit predicts of the intersection at one σ, averaged over the sides. */
export type Prediction = {
  /** σ, in the unit of A. */
  sigma: number,
  /** E d(x′, x), in the unit of A. */
  distance: number,
  /** d at the most plausible common shape. */
  nearest: number,
  /** q_eff. */
  effectiveDimensions: number,
  /** How implausible the most plausible common shape is, ‖μ‖. */
  meanNorm: number,
};

/** The intersection at another σ, by the Gaussian fits alone. */
export type Preview = {
  /** Distances. */
  prediction: Prediction,
  /** Shapes. */
  shapes: RegionShapes,
};

/** The intersection at one σ of a sweep. */
export type SweepPoint = {
  /** Root mean square over the points of the standard deviation, in the unit of A. */
  vertexSd: number,
  /** Distances of the intersection model to A, to B and to their union, as in the paper. */
  grassmann: Grassmann,
  /** σ, in the unit of A. */
  sigma: number,
  /** E d(x′, x), in the unit of A. */
  distance: number,
  /** d at the most plausible common shape. */
  nearest: number,
  /** q_eff. */
  effectiveDimensions: number,
  /** How implausible the most plausible common shape is, ‖μ‖. */
  meanNorm: number,
};

/** A space of shapes that can be walked through. */
export type Space = "a" | "b" | "intersection";

/** How the axes of a space are chosen. The last three are for A and B. */
export type AxesKind = "modes" | "exclusive" | "relative" | "angles";

/** The axes of a space. */
export type Axes = {
  /** The space. */
  space: Space,
  /** How they are chosen. */
  kind: AxesKind,
  /** What orders them; see the head of this module. Angles are in degrees. */
  values: Array<number>,
  /** How far one unit moves the shape, root mean square over the points. */
  reach: Array<number>,
  /** What of that the other model cannot make, root mean square over the points; 0 for the intersection. */
  residual: Array<number>,
  /** τ of the relative ones. */
  noise: number | null,
};

/** The nearest shape of a model to some shape x. */
export type Nearest = {
  /** x′ (d·n). */
  shape: Float32Array,
  /** ‖x_v − x′_v‖ at every vertex (n). */
  residuals: Float32Array,
  /** d(x′, x), their mean. */
  distance: number,
  /** ‖a′‖. */
  norm: number,
  /** P(χ²_q ≥ ‖a′‖²): the share of the model's own shapes that are less plausible. */
  plausibility: number,
  /** L_D = exp(−½(d/σ)²) at the σ in use; `None` before there is one. */
  likelihood: number | null,
};

/** A shape of a space, and what both models make of it. */
export type Explored = {
  /** The shape (d·n). */
  shape: Float32Array,
  /** Its coefficients in the modes of the space, in standard deviations (q). */
  coefficients: Float32Array,
  /** ‖a‖. */
  norm: number,
  /** P(χ²_q ≥ ‖a‖²). */
  plausibility: number,
  /** Its nearest shapes in A and in B, if asked for. */
  nearest: Sides<Nearest> | null,
};

/** What a map shows at every vertex, in the unit of A unless it says otherwise. */
export type MapName = "sd" | "sd-normal" | "sd-tangential" | "distance" | "reach" | "offset" | "chance" | "means" | "ratio" | "mode";

/** A number at every vertex. */
export type VertexMap = {
  /** The numbers (n). */
  values: Float32Array,
  /** Whether 0 is the middle of the scale. */
  signed: boolean,
};

/** How a vertex varies. */
export type Ellipsoid = {
  /** Its mean position (d). */
  centre: Array<number>,
  /** The principal semi-axes of one standard deviation, one after the other, longest first (d × d). */
  axes: Array<number>,
};

/** What the chains of one side did with one coefficient. */
export type ChainPlots = {
  /** Number of chains. */
  chains: number,
  /** Draws of each chain in `draws`. */
  length: number,
  /** Every stride-th draw is in `draws`. */
  every: number,
  /** The coefficient, chain after chain. */
  draws: Float32Array,
  /** d(x′, x) of the same draws. */
  distances: Float32Array,
  /** Bins of a rank plot. */
  bins: number,
  /** Of all draws, how many of a chain (rows) have their rank in a bin (columns). */
  ranks: Uint32Array,
  /** From lag 0 on, the mean over the chains, until it is lost in noise. */
  autocorrelation: Float32Array,
};

/** Draws of the first coefficients of one side, and the Gaussians beside them. */
export type PairPlots = {
  /** The modes, from 0. */
  modes: Array<number>,
  /** Number of draws. */
  count: number,
  /** Draws, count × modes. */
  draws: Float32Array,
  /** The Gaussian fit; stored runs have none. */
  fit: Moments | null,
  /** Mean (p). */
  mean: Array<number>,
  /** Covariance (p × p). */
  covariance: Array<number>,
};

/** One of the models of a run. */
export type RunModel = {
  /** Its name. */
  name: string,
  /** The part of its file. */
  part: string | null,
  /** `demo:NAME`, an address, or nothing. */
  source: string | null,
  /** Its fingerprint; unknown in reports of old engines. */
  fingerprint: string | null,
  /** How it was read, as text. */
  reading?: string,
  /** The shapes that were given beside it. */
  shapes?: KnownShapes,
};

/** Where the two models of a run are from: `demo:NAME`, an address, or nothing. */
export type Sources = {
  /** Of model A. */
  a: string | null,
  /** Of model B. */
  b: string | null,
};

/** A comparison that can be repeated. */
export type RunFile = {
  /** Version of the layout: 1. */
  shapevenn: number,
  /** Version of the engine that wrote it. */
  engine: string,
  /** The two models. */
  models: Sides<RunModel>,
  /** Everything else that decides the draws. */
  settings: Settings,
};

/** The mean or a sample of a region, exactly as it is shown. */
export type ShownShape = {
  /** The region. */
  region: Region,
  /** The mean, or a sample of the same seed and count. */
  index: number,
  /** Number of samples that the seed picks. */
  count: number,
  /** The seed, decimal. */
  seed: string,
  /** γ in x + γ r(a), of a difference. */
  exaggeration: number,
  /** Which shapes of a difference. */
  picture: DifferenceShapes,
};

/** What can be saved from a run. */
export type Download = {
  "kind": "intersection-h5"
} | {
  "kind": "intersection-json"
} | {
  "kind": "intersection-npz"
} | {
  "kind": "intersection-plain-json"
} | {
  "kind": "intersection-glb"
} | {
  "kind": "draws-npz"
} | {
  "kind": "draws-json"
} | {
  "kind": "draws-csv"
} | {
  "kind": "report-json"
} | {
  "kind": "report-csv"
} | {
  "kind": "run-json"
} & Sources | {
  "kind": "coefficients-csv"
} | {
  "kind": "modes-csv"
} | {
  "kind": "ply"
} & ShownShape | {
  "kind": "obj"
} & ShownShape | {
  "kind": "glb"
} & ShownShape;

/** What two models are compared, and how. */
export type Opening = {
  /** "stars-1" … "stars-6" or "planes". */
  pair: string,
  /** The first so many modes of both; all where left out. */
  modes: number | null,
  /** σ; 0.003 for stars and 0.3 for planes where left out. */
  sigma: number | null,
  /** How the plausibilities under A and B are put together. */
  plausibility: Plausibility,
  /** By how many degrees B is turned about the origin before it is compared. */
  turned: number,
  /** Angle between the planes, in degrees. */
  tilt: number,
  /** Where B's centre lies along the planes' common line. */
  shift: number,
  /** How far B's centre lies above A's plane. */
  lift: number,
};

/** What chains draw from. */
export type LessonTarget = "intersection" | "difference" | "prior" | "normal";

/** How it is drawn from. */
export type LessonSampler = "paper" | "paper-corrected" | "mala" | "hmc" | "independence" | "pcn" | "rejection";

/** What a field is of. */
export type FieldName = "prior" | "intersection" | "difference" | "distance" | "likelihood" | "normal";

/** How chains begin. */
export type Beginning = {
  /** What they draw from. */
  target: LessonTarget,
  /** Whose coefficients they move. */
  side?: Side,
  /** How. */
  sampler: LessonSampler,
  /** How many; rejection has one row whatever is asked. */
  chains?: number,
  /** Decimal, as numbers of JSON cannot hold 64 bits. */
  seed?: string,
  /** Steps of each chain that are thrown away at its start. */
  burnIn?: number,
  /** Dimension of the standard normal distribution. */
  dimension?: number | null,
  /** Where all chains start; else where the sampler starts them. */
  start?: Array<number> | null,
};

/** What can be asked. */
export type LessonAsk = {
  "ask": "open"
} & Partial<Opening> | {
  "ask": "point",
  /** Of which model it is. */
  side: Side,
  /** a; missing ones are 0. */
  coefficients: Array<number>,
} | {
  "ask": "project",
  /** In which model. */
  side: Side,
  /** x (d·n). */
  shape: Array<number>,
} | {
  "ask": "field",
  /** What. */
  of: FieldName,
  /** Whose coefficients. */
  side?: Side,
  /** Which two, across and upwards, from 0. */
  modes: [number, number],
  /** The other coefficients; missing ones are 0. */
  at?: Array<number>,
  /** From −extent to extent. */
  extent: number,
  /** Rows and columns. */
  size: number,
} | {
  "ask": "begin",
  /** Their number from now on. */
  group: number,
  /** What they draw from. */
  target: LessonTarget,
  /** Whose coefficients they move. */
  side?: Side,
  /** How. */
  sampler: LessonSampler,
  /** How many; rejection has one row whatever is asked. */
  chains?: number,
  /** Decimal, as numbers of JSON cannot hold 64 bits. */
  seed?: string,
  /** Steps of each chain that are thrown away at its start. */
  burnIn?: number,
  /** Dimension of the standard normal distribution. */
  dimension?: number | null,
  /** Where all chains start; else where the sampler starts them. */
  start?: Array<number> | null,
} | {
  "ask": "advance",
  /** Which group of chains. */
  group: number,
  /** How many. */
  steps: number,
  /** Whether single steps are told. */
  watch?: boolean,
} | {
  "ask": "draws",
  /** Which group of chains. */
  group: number,
  /** How many at the most. */
  most: number,
} | {
  "ask": "summary",
  /** Which group of chains. */
  group: number,
} | {
  "ask": "intersection",
  /** That of A, that of B. */
  groups: [number, number],
  /** Draws of each group after which d_G is told. */
  counts?: Array<number>,
} | {
  "ask": "shapes",
  /** Which group of chains. */
  group: number,
  /** Of which model, where the group knows none. */
  side?: Side | null,
  /** How many at the most. */
  most: number,
} | {
  "ask": "principal",
  /** Which group of chains. */
  group: number,
};

/** A model as it is drawn. */
export type LessonModel = {
  /** Mean (d·n). */
  mean: Array<number>,
  /** Scaled basis U, mode after mode (q × d·n). */
  basis: Array<number>,
  /** √λ (q). */
  standardDeviations: Array<number>,
  /** Root mean square displacement of every point (n). */
  vertexSd: Array<number>,
};

/** The two models and what is known of them without a draw. */
export type LessonModels = {
  /** Coordinates per point, d. */
  dimension: 2 | 3,
  /** n. */
  points: number,
  /** How the points are joined. */
  segments: Array<[number, number]> | null,
  /** σ in use. */
  sigma: number,
  /** Model A. */
  a: LessonModel,
  /** Model B, as it is compared. */
  b: LessonModel,
  /** What they are known to share, where nothing was turned or cut. */
  truth: LessonModel | null,
  /** A∩B by the Gaussian fits alone. */
  intersection: LessonModel,
  /** Those fits, in coefficients. */
  fits: Sides<Moments>,
  /** Principal angles, in degrees, smallest first. */
  angles: Array<number>,
  /** E d under the fits. */
  distances: Sides<number>,
  /** The σ that the engine recommends. */
  recommended: number,
};

/** What there is to say of one shape. */
export type LessonPoint = {
  /** x (d·n). */
  shape: Array<number>,
  /** x′, its nearest shape in the other model (d·n). */
  nearest: Array<number>,
  /** a′, the coefficients of that. */
  projected: Array<number>,
  /** d(x′, x). */
  distance: number,
  /** ‖x_v − x′_v‖ at every point (n). */
  vertexDistances: Array<number>,
  /** L_D. */
  distanceLikelihood: number,
  /** L_P = exp(−½‖a′‖²). */
  projectionLikelihood: number,
  /** −½‖a‖². */
  logPrior: number,
  /** Of the intersection posterior, up to a constant. */
  logDensity: number,
  /** Its gradient (q). */
  gradient: Array<number>,
  /** Of the difference; nothing where it is −∞. */
  logDifference: number | null,
  /** P(χ²_q ≥ ‖a‖²): the share of the model's shapes that are less plausible. */
  plausibility: number,
  /** ‖a‖. */
  norm: number,
};

/** Numbers over two coefficients. */
export type LessonField = {
  /** Row by row, the second coefficient falling (size × size). */
  values: Float32Array,
  /** The highest of them. */
  highest: number,
  /** The lowest that is finite. */
  lowest: number,
};

/** Where chains are before their first step. */
export type ChainGroupStart = {
  /** chains × q; nothing for rejection. */
  states: Array<number>,
  /** q. */
  dimension: number,
  /** Number of chains, 1 for rejection. */
  chains: number,
};

/** One decision of one chain. */
export type LessonStep = {
  /** Which chain. */
  chain: number,
  /** Which part of the mixture proposed; 3 is the scaling move. */
  part: number,
  /** a (q). */
  from: Array<number>,
  /** a′ (q). */
  proposal: Array<number>,
  /** log p(a). */
  logDensityFrom: number,
  /** log p(a′). */
  logDensityTo: number,
  /** Logarithm of the Hastings factor. */
  logHastings: number,
  /** log p(a′) − log p(a) + logHastings. */
  logRatio: number,
  /** u; accepted where log u < logRatio. */
  uniform: number,
  /** Whether it was. */
  accepted: boolean,
  /** d of the proposal; nothing where there are no models. */
  distance: number | null,
};

/** How far a group of chains is. */
export type ChainGroupProgress = {
  /** Steps of each chain so far, the burn-in included; of rejection, draws. */
  step: number,
  /** Draws kept, over all chains. */
  draws: number,
  /** Evaluations of the density, a gradient counted twice. */
  evaluations: number,
  /** Proposals accepted after the burn-in. */
  accepted: number,
  /** Proposals made after the burn-in. */
  proposed: number,
  /** Where the chains are (chains × q); of rejection, its last draw. */
  states: Array<number>,
  /** The single steps, where they were watched and the sampler is one of the walks. */
  steps: Array<LessonStep>,
  /** Whether the group does no more. */
  ended: boolean,
};

/** Draws, evenly thinned. */
export type ChainGroupDraws = {
  /** Chain after chain (count × q). */
  values: Float32Array,
  /** d of each (count); nothing where there are no models. */
  distances: Float32Array,
  /** How many. */
  count: number,
  /** Of so many chains, count/chains each. */
  chains: number,
  /** Every stride-th draw of a chain. */
  every: number,
};

/** What draws say of their target, and of themselves. */
export type ChainGroupSummary = {
  /** Number of chains. */
  chains: number,
  /** Draws over all chains. */
  draws: number,
  /** Evaluations of the density, burn-in included, a gradient counted twice. */
  evaluations: number,
  /** Share of proposals accepted after the burn-in. */
  acceptance: number,
  /** Largest R-hat of all coefficients; nothing of independent or too few draws. */
  rHatMax: number | null,
  /** Smallest bulk effective sample size of all coefficients. */
  essBulkMin: number | null,
  /** The same for every 1000 evaluations. */
  essPerThousand: number | null,
  /** Mean of ‖a‖²/q. */
  meanSquare: number,
  /** Mean d; nothing where there are no models. */
  meanDistance: number | null,
  /** Of rejection: the share of the prior that is in the target, E[1 − L_D] of a difference. */
  probability: number | null,
  /** Its standard error. */
  standardError: number | null,
  /** Mean (p). */
  mean: Array<number>,
  /** Covariance (p × p). */
  covariance: Array<number>,
};

/** d_G after some draws. */
export type Fall = {
  /** Draws of each group. */
  draws: number,
  /** d_G to the truth, the paper's. */
  grassmann: number | null,
};

/** A∩B from draws. */
export type LessonIntersection = {
  /** Principal components of all draws of both groups. */
  model: LessonModel,
  /** d_G to the truth, the paper's; nothing where no truth is known. */
  grassmann: number | null,
  /** The same by Lim, Wong and Ye's definition. */
  grassmannAffine: number | null,
  /** d_G of the Gaussian fits alone. */
  closedForm: number | null,
  /** d_G after some draws. */
  falls: Array<Fall>,
  /** The error of sampling alone that is expected at these counts. */
  predicted: Array<number | null>,
};

/** Shapes of draws. */
export type ChainGroupShapes = {
  /** Shape after shape (count × d·n). */
  values: Float32Array,
  /** How many. */
  count: number,
};

/** What principal components would make of a difference. */
export type LessonPrincipal = {
  /** Share of shapes of that Gaussian with L_D > ½: more in the other model than not. */
  misled: number,
  /** The same share of the draws themselves. */
  misledDraws: number,
  /** Whose coefficients. */
  side: Side,
  /** Mean (p). */
  mean: Array<number>,
  /** Covariance (p × p). */
  covariance: Array<number>,
};
