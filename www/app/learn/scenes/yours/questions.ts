/** Questions about the comparison of heads, with answers; the numbers are those of `shapevenn compare`. */
import { ENGINE } from "../../../state/settings";

export interface TryOut {
  ask: string;
  href: string;
  link: string;
  answer: string;
}

export const TRY_OUT: readonly TryOut[] = [
  {
    ask: "How many male heads can the female model not make?",
    href: "#v=1&demo=heads-sex&sigma=1&view=sd&map=distance",
    link: "Male and female heads, coloured by the distance to the other model",
    answer:
      "With σ = 1 mm about 92 % of the male heads lie outside the female model, and 86 % the other " +
      "way round. But the female model can make 94 % of the variance of the male one, and the mean " +
      "distance of those outside is about 2 mm. A share says how often heads differ, not by how much; the " +
      "colours show how much, and where.",
  },
  {
    ask: "And with σ = 0.3 mm?",
    href: "#v=1&demo=heads-sex&sigma=0.3",
    link: "The same heads with σ = 0.3 mm",
    answer:
      "Then practically every head of one model lies outside the other, both differences look like " +
      "the models themselves, and the page says so. Never quote a share without its σ.",
  },
  {
    ask: "What do identity and expression have in common?",
    href: `#v=1&engine=${ENGINE}&demo=heads-expression`,
    link: "Identity and expression",
    answer:
      "Little: expression can make about a fifth of the variance of identity, and identity less than " +
      "half of that of expression. The method returns an A∩B nevertheless: check how far its shapes " +
      "lie from both models before you call them common.",
  },
];
