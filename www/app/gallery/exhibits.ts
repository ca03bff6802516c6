/** Comparisons of what comes with the page: where each is, and what there is to see. */

export interface Exhibit {
  /** Of its picture, `gallery/NAME-light.webp` and `-dark.webp`. */
  name: string;
  title: string;
  /** Without the version, which comes first. */
  link: string;
  see: string;
}

export interface ExhibitGroup {
  title: string;
  exhibits: Exhibit[];
}

export const HALLS: ExhibitGroup[] = [
  {
    title: "Heads",
    exhibits: [
      {
        name: "heads-sex",
        title: "Male and female heads",
        link: "demo=heads-sex&sigma=1&view=mean",
        see: "Two models that nearly agree: each can make most of what varies in the other, and yet most of their heads are out of each other’s reach.",
      },
      {
        name: "heads-distance",
        title: "Where they cannot follow each other",
        link: "demo=heads-sex&sigma=1&view=sd&map=distance&camera=0.35,0.05,1.00",
        see: "Every vertex in the colour of its mean distance to the nearest shape of the other model, all five regions on one scale.",
      },
      {
        name: "heads-exclusive",
        title: "What only one of them can make",
        link: "demo=heads-sex&sigma=1&view=mean&picture=exclusiveModes&exaggerate=3",
        see: "The mean of what only one model can make, pushed three times further away from the other.",
      },
      {
        name: "heads-follow",
        title: "Can the female model follow?",
        link: "demo=heads-sex&sigma=1&room=explore&explore=a,exclusive,3",
        see: "Three standard deviations along the direction that the other model misses most, its nearest head, and a map of what is missing.",
      },
      {
        name: "heads-expression",
        title: "Identity and expression",
        link: "demo=heads-expression&view=sd",
        see: "Two ways of changing a head: expressions make less than a fifth of how identities vary, identities nearly half of how expressions do. The map shows where.",
      },
      {
        name: "heads-table",
        title: "All four, one by one",
        link: "demo=heads-sex&sigma=1&room=models&shelf=heads-male,heads-female,heads-identity,heads-expression",
        see: "Each row says how much of a model’s variance the others can make; a cell opens that comparison.",
      },
    ],
  },
  {
    title: "The paper’s stars, and two planes",
    exhibits: [
      {
        name: "stars-samples",
        title: "What two stars share",
        link: "demo=stars-6&sigma=0.003&view=samples",
        see: "A sweeps the top tip and one other, B the top tip and a third. Only the sweep of the top tip is common, and it is all that A∩B can make.",
      },
      {
        name: "stars-small",
        title: "A narrow overlap",
        link: "demo=stars-1&sigma=0.003&view=samples",
        see: "The same two models, but they agree on ten degrees of the top tip only.",
      },
      {
        name: "stars-walk",
        title: "The paper’s own sampler",
        link: "demo=stars-5&sigma=0.003&sampler=paper-corrected&chains=15&draws=2505&burnin=1000&thin=1&room=diagnostics",
        see: "The random walk at the paper’s length: 15 chains that hardly leave where they began, and a handful of effective draws among tens of thousands.",
      },
      {
        name: "planes",
        title: "Two ellipses in space",
        link: "demo=planes&view=samples",
        see: "The smallest case: two planes meet in a line, and A∩B is the piece of it that lies in both ellipses.",
      },
      {
        name: "planes-tolerance",
        title: "A tolerance too large",
        link: "demo=planes&sigma=3&view=samples",
        see: "The same ellipses at σ = 3: distance says next to nothing, and A∩B is whatever is plausible in both, wherever the planes lie.",
      },
    ],
  },
];

export const EXHIBITS: Exhibit[] = HALLS.flatMap(({ exhibits }) => exhibits);

export function linkTo({ link }: Exhibit): string {
  return `#v=1&${link}`;
}
