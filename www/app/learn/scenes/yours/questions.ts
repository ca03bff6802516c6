/** What to look for once faces are compared; the numbers are those of `shapevenn compare`. */
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
      "way. That sounds like two species. But the female model makes 94 % of the variance of the male " +
      "one, and what it misses is 2 mm on average. A share says how often, not how much; the colours " +
      "say how much, and where.",
  },
  {
    ask: "And if near means 0.3 mm?",
    href: "#v=1&demo=heads-sex&sigma=0.3",
    link: "The same heads with σ = 0.3 mm",
    answer:
      "Then practically every head of one model lies outside the other, both differences look like " +
      "the models themselves, and the page says so. Never quote a share without its σ.",
  },
  {
    ask: "What do identity and expression have in common?",
    href: "#v=1&demo=heads-expression",
    link: "Identity and expression",
    answer:
      "Little: expression makes about a fifth of the variance of identity, and identity not half of " +
      "that of expression. A∩B exists all the same, since whoever asks for the nearest gets an answer: " +
      "look at how far its shapes lie from both models before you call it common.",
  },
];
