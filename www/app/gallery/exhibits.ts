/** The example comparisons of the gallery: link, picture and explanation of each. */
import { ENGINE } from "../state/settings";

export { ENGINE };

export interface Exhibit {
  /** Name of its pictures, `gallery/NAME-light.webp` and `-dark.webp`. */
  name: string;
  title: string;
  /** The link without its versions. */
  link: string;
  see: string;
}

export interface ExhibitGroup {
  title: string;
  exhibits: Exhibit[];
}

export const EXHIBIT_GROUPS: ExhibitGroup[] = [
  {
    title: "Heads",
    exhibits: [
      {
        name: "heads-sex",
        title: "Male and female heads",
        link: "demo=heads-sex&sigma=1",
        see: "What each model misses of the other: both means pushed away from the other model, coloured by how far a head lies from the nearest that the other can make.",
      },
      {
        name: "heads-distance",
        title: "Distance to the other model",
        link: "demo=heads-sex&sigma=1&view=sd&map=distance&camera=0.35,0.05,1.00",
        see: "Colours show the distance of each vertex to the nearest shape of the other model, all five regions on one scale.",
      },
      {
        name: "heads-exclusive",
        title: "What only one of them can make",
        link: "demo=heads-sex&sigma=1&view=mean&picture=exclusiveModes&exaggerate=3",
        see: "The mean of each model with three times the part that the other model misses added to it.",
      },
      {
        name: "heads-pairs",
        title: "The female model’s best try",
        link: "demo=heads-sex&sigma=1&view=pairs",
        see: "A male head of the population and the nearest that the female model can make, and the other way round.",
      },
      {
        name: "heads-evidence",
        title: "More than chance?",
        link: "demo=heads-sex&sigma=1&room=evidence",
        see: "The populations divided anew at random, again and again: how far two groups of one population would lie apart, and how far these two do.",
      },
      {
        name: "heads-follow",
        title: "Can the female model make this head?",
        link: "demo=heads-sex&sigma=1&room=explore&explore=a,exclusive,3",
        see: "A male head three standard deviations along the first exclusive mode, the nearest female head, and a map of the difference.",
      },
      {
        name: "heads-expression",
        title: "Identity and expression",
        link: "demo=heads-expression&view=sd",
        see: "Two ways in which heads vary: expressions can make less than a fifth of the variance of identities, identities nearly half of that of expressions. The map shows where each varies.",
      },
      {
        name: "heads-table",
        title: "All four head models, pair by pair",
        link: "demo=heads-sex&sigma=1&room=models&shelf=heads-male,heads-female,heads-identity,heads-expression",
        see: "Each row shows how much of a model’s variance the others can make; a cell opens that comparison.",
      },
    ],
  },
  {
    title: "Wings",
    exhibits: [
      {
        name: "wings",
        title: "Two genera of mosquitoes",
        link: "demo=wings&view=pairs&rank=100",
        see: "Landmarks of real wings (Rohlf and Slice, 1990): the wing of Aedes that is furthest from Culex beside the nearest that Culex can make. Its distance is more than chance would give.",
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
        see: "A moves the top tip and one other, B the top tip and a third. Only the movement of the top tip is common, and it is all that A∩B can make.",
      },
      {
        name: "stars-small",
        title: "A narrow overlap",
        link: "demo=stars-1&sigma=0.003&view=samples",
        see: "The same kind of models, but only ten degrees of the top tip are common.",
      },
      {
        name: "stars-walk",
        title: "The paper’s own sampler",
        link: "demo=stars-5&sigma=0.003&sampler=paper-corrected&chains=15&draws=2505&burnin=1000&thin=1&room=diagnostics",
        see: "The random walk with the paper’s number of steps: 15 chains that stay near their starting points, and only a few effective draws among tens of thousands.",
      },
      {
        name: "planes",
        title: "Two ellipses in space",
        link: "demo=planes&view=samples",
        see: "The smallest case: two planes meet in a line, and A∩B lies along the segment inside both ellipses.",
      },
      {
        name: "planes-tolerance",
        title: "A tolerance too large",
        link: "demo=planes&sigma=3&view=samples",
        see: "The same ellipses at σ = 3: the distance hardly matters, and A∩B contains all points that are plausible in both models.",
      },
    ],
  },
];

export const EXHIBITS: Exhibit[] = EXHIBIT_GROUPS.flatMap(({ exhibits }) => exhibits);

export function linkTo({ link }: Exhibit): string {
  return `#v=1&engine=${ENGINE}&${link}`;
}
