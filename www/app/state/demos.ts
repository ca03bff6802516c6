/** The example pairs of models that come with the page. */

/** Names of two models and of their shapes, for sentences. */
export interface Nouns {
  a: string;
  b: string;
  modelA: string;
  modelB: string;
  shapeOfA: string;
  shapeOfB: string;
  shapesOfA: string;
  shapesOfB: string;
}

/** `a` and `b` name models or shapes, as “model A” and “star A”. */
export function nounsOf(a: string, b: string): Nouns {
  return { a, b, ...nounsOfModels(a, b) };
}

/** `a` and `b` say what a model is of, as “identity” and “expression”. */
export function nounsOfParts(a: string, b: string): Nouns {
  return { a, b, ...nounsOfModels(`the ${a} model`, `the ${b} model`) };
}

function nounsOfModels(a: string, b: string): Omit<Nouns, "a" | "b"> {
  return {
    modelA: a,
    modelB: b,
    shapeOfA: `a shape of ${a}`,
    shapeOfB: `a shape of ${b}`,
    shapesOfA: `the shapes of ${a}`,
    shapesOfB: `the shapes of ${b}`,
  };
}

/** The same with A and B exchanged. */
export function exchanged(nouns: Nouns): Nouns {
  return {
    a: nouns.b,
    b: nouns.a,
    modelA: nouns.modelB,
    modelB: nouns.modelA,
    shapeOfA: nouns.shapeOfB,
    shapeOfB: nouns.shapeOfA,
    shapesOfA: nouns.shapesOfB,
    shapesOfB: nouns.shapesOfA,
  };
}

export interface Demo {
  /** Name in links. */
  id: string;
  label: string;
  a: string;
  b: string;
  nouns: Nouns;
  note: string;
  /** σ of the example, where the recommended one would not show its point. */
  sigma?: number;
}

const HEADS_NOTE =
  "An artist-made parametric head (MakeHuman, CC0), population sampled by us; not scan statistics.";

const heads: Demo[] = [
  {
    id: "heads-sex",
    label: "Heads: male and female",
    a: "heads-male",
    b: "heads-female",
    nouns: {
      a: "male heads",
      b: "female heads",
      modelA: "the male model",
      modelB: "the female model",
      shapeOfA: "a male head",
      shapeOfB: "a female head",
      shapesOfA: "male heads",
      shapesOfB: "female heads",
    },
    note: HEADS_NOTE,
    sigma: 1,
  },
  {
    id: "heads-expression",
    label: "Heads: identity and expression",
    a: "heads-identity",
    b: "heads-expression",
    nouns: nounsOfParts("identity", "expression"),
    note: HEADS_NOTE,
  },
];

const wings: Demo = {
  id: "wings",
  label: "Mosquito wings: Aedes and Culex",
  a: "wings-aedes",
  b: "wings-culex",
  nouns: {
    a: "Aedes",
    b: "Culex",
    modelA: "the Aedes model",
    modelB: "the Culex model",
    shapeOfA: "a wing of Aedes",
    shapeOfB: "a wing of Culex",
    shapesOfA: "wings of Aedes",
    shapesOfB: "wings of Culex",
  },
  note: "18 landmarks of 57 and 25 wings, measured by Rohlf and Slice (1990), from ktch (Apache-2.0); aligned together, in one size.",
};

const stars: Demo[] = [1, 2, 3, 4, 5, 6].map((pair) => ({
  id: `stars-${pair}`,
  label: `Stars, pair ${pair}`,
  a: `stars-${pair}-a`,
  b: `stars-${pair}-b`,
  nouns: nounsOf("star A", "star B"),
  note: "One of the paper’s six pairs of stars, whose true intersection is known.",
}));

const planes: Demo = {
  id: "planes",
  label: "Two planes in space",
  a: "planes-a",
  b: "planes-b",
  nouns: nounsOf("plane A", "plane B"),
  note: "Two ellipses in two planes: the smallest case in which two models meet.",
};

export const DEMO_GROUPS: { label: string; demos: Demo[] }[] = [
  { label: "Heads", demos: heads },
  { label: "Wings", demos: [wings] },
  { label: "Stars from the paper", demos: stars },
  { label: "Geometry", demos: [planes] },
];

const DEMOS: Demo[] = DEMO_GROUPS.flatMap(({ demos }) => demos);

/** The models of all pairs. */
export const DEMO_MODELS: string[] = DEMOS.flatMap(({ a, b }) => [a, b]);

const FIRST = heads[0] as Demo;

/** The comparison that is stored with the page. */
export const FIRST_DEMO: Demo = FIRST;

export function findDemo(id: string): Demo | undefined {
  return DEMOS.find((demo) => demo.id === id);
}

/** The pair of these two models, A first. */
export function demoOf(a: string, b: string): Demo | undefined {
  return DEMOS.find((demo) => demo.a === a && demo.b === b);
}

/** The file of an example model; null if the engine computes it. */
export function packagedFile(model: string): string | null {
  return model.startsWith("heads-") ? `demos/${model}.npz` : null;
}
