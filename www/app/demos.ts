/** The pairs of models that come with the page. */

export interface Demo {
  /** As in the link. */
  id: string;
  label: string;
  a: string;
  b: string;
  /** What the two are called in a sentence. */
  nouns: { a: string; b: string };
  note: string;
}

const HEADS_NOTE =
  "An artist-made parametric head (MakeHuman, CC0), population sampled by us; not scan statistics.";

const heads: Demo[] = [
  {
    id: "heads-sex",
    label: "Heads: male and female",
    a: "heads-male",
    b: "heads-female",
    nouns: { a: "male heads", b: "female heads" },
    note: HEADS_NOTE,
  },
  {
    id: "heads-expression",
    label: "Heads: identity and expression",
    a: "heads-identity",
    b: "heads-expression",
    nouns: { a: "the identity model", b: "the expression model" },
    note: HEADS_NOTE,
  },
];

const stars: Demo[] = [1, 2, 3, 4, 5, 6].map((pair) => ({
  id: `stars-${pair}`,
  label: `Stars, pair ${pair}`,
  a: `stars-${pair}-a`,
  b: `stars-${pair}-b`,
  nouns: { a: "star A", b: "star B" },
  note: "One of the paper’s six pairs of stars, whose true intersection is known.",
}));

const planes: Demo = {
  id: "planes",
  label: "Two planes in space",
  a: "planes-a",
  b: "planes-b",
  nouns: { a: "plane A", b: "plane B" },
  note: "Two ellipses in two planes: the smallest case in which two models meet.",
};

export const DEMO_GROUPS: { label: string; demos: Demo[] }[] = [
  { label: "Heads", demos: heads },
  { label: "Stars from the paper", demos: stars },
  { label: "Geometry", demos: [planes] },
];

const FIRST = heads[0] as Demo;

/** The comparison that is stored with the page. */
export const FIRST_DEMO: Demo = FIRST;

export function findDemo(id: string): Demo | undefined {
  return DEMO_GROUPS.flatMap((group) => group.demos).find((demo) => demo.id === id);
}

/** The packaged file of a demo model; none where the engine makes it by code. */
export function packagedFile(model: string): string | null {
  return model.startsWith("heads-") ? `demos/${model}.npz` : null;
}
