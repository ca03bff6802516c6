/** Goals of the lessons, and plans for lectures of 45 and 90 minutes: scenes, minutes, activities, questions. */
import type { SceneName } from "../../scenes";

export interface Goal {
  scene: SceneName;
  /** Completes the sentence “Students can …”. */
  can: string;
}

export const GOALS: readonly Goal[] = [
  {
    scene: "model",
    can: "point out mean, mode, coefficient and standard deviation in a picture, and explain how ‖α‖ measures plausibility",
  },
  {
    scene: "agree",
    can: "explain what “both can make it” means: near a shape of the other model, and plausible in both",
  },
  {
    scene: "planes",
    can: "find x′, d and both likelihoods in a drawing, and explain the role of σ",
  },
  {
    scene: "step",
    can: "carry out a Metropolis–Hastings step by hand, and explain why no normalising constant is needed",
  },
  {
    scene: "cloud",
    can: "compute a model from draws by principal component analysis, and predict how its error depends on their number",
  },
  {
    scene: "difference",
    can: "explain why the difference has draws but no model",
  },
  {
    scene: "race",
    can: "compare samplers by effective draws, and recognise a run that has not converged",
  },
  {
    scene: "yours",
    can: "read a comparison of two real models, and question its results",
  },
];

export interface Part {
  minutes: number;
  scene: SceneName;
  act: string;
  /** Question for the class. */
  question: string;
}

export interface Plan {
  name: string;
  parts: readonly Part[];
}

export const PLANS: readonly Plan[] = [
  {
    name: "45 minutes: a lecture",
    parts: [
      {
        minutes: 6,
        scene: "model",
        act: "Watch the animation. Pause (Space), drag along α₁ alone, then α₂, then to the third ring.",
        question: "Which of two shapes is more plausible: α = (2, 0) or (0, 2)?",
      },
      {
        minutes: 6,
        scene: "agree",
        act: "Vote on each tip by show of hands. Reveal. Raise σ until other tips move.",
        question: "Why does A∩B move the tip less than A and B do?",
      },
      {
        minutes: 7,
        scene: "planes",
        act: "Drag x along the line, then across it. “At right angles”, “Almost flat”, “Parallel”.",
        question: "Where on A is d = 0? Where is x common to both?",
      },
      {
        minutes: 10,
        scene: "step",
        act: "Five single steps (S), explained aloud. Then run it, faster and faster; then four chains.",
        question: "The proposal is less probable. Why is it ever accepted?",
      },
      {
        minutes: 6,
        scene: "cloud",
        act: "Run until all draws are made; read the curve of the Grassmann distance.",
        question: "How many draws for half the error?",
      },
      {
        minutes: 5,
        scene: "difference",
        act: "Flip the likelihood. Look at the hole, then at the ellipse over it.",
        question: "Which shapes would a PCA of these draws make?",
      },
      {
        minutes: 3,
        scene: "race",
        act: "Run it, then choose “Uncorrected scaling”.",
        question: "How can one detect it?",
      },
      {
        minutes: 2,
        scene: "yours",
        act: "Open the heads; give the link to the class.",
        question: "What do the models have in common, and at which σ?",
      },
    ],
  },
  {
    name: "90 minutes: with exercises in pairs",
    parts: [
      {
        minutes: 10,
        scene: "model",
        act: "As above; then pairs search for the least plausible shape that still looks like a star.",
        question: "With 50 modes, are most shapes near the mean?",
      },
      {
        minutes: 10,
        scene: "agree",
        act: "Guess in pairs, reveal. The other five pairs of the paper: what changes, what does not?",
        question: "How many modes does A∩B need?",
      },
      {
        minutes: 15,
        scene: "planes",
        act: "Pairs write down d and both likelihoods for three points before they look.",
        question: "What does a sampler return for parallel planes?",
      },
      {
        minutes: 15,
        scene: "step",
        act: "Each pair takes its own seed and does ten steps on paper, with the numbers shown.",
        question: "Where does the Hastings factor of the scaling move come from?",
      },
      {
        minutes: 10,
        scene: "cloud",
        act: "Each pair uses another sampler; collect the Grassmann distances at 2,000 draws.",
        question: "R-hat is 1.5. What do you do?",
      },
      {
        minutes: 10,
        scene: "difference",
        act: "σ from small to large; note the share of A that B cannot make.",
        question: "What does the share mean without σ?",
      },
      {
        minutes: 12,
        scene: "race",
        act: "Four groups, one failure each; each explains to the others how to detect it.",
        question: "What can a single chain not tell you?",
      },
      {
        minutes: 8,
        scene: "yours",
        act: "Heads, or models that students bring; the three questions.",
        question: "Would you publish this result?",
      },
    ],
  },
];

/** Start of each part of a plan, in minutes. */
export function beginnings({ parts }: Plan): number[] {
  let minute = 0;
  return parts.map(({ minutes }) => {
    const begins = minute;
    minute += minutes;
    return begins;
  });
}
