/** How a lecture may go: what is done in which scene, for how long, and what is asked. */
import type { SceneName } from "../../scenes";

export interface Goal {
  scene: SceneName;
  /** Afterwards, students can … */
  can: string;
}

export const GOALS: readonly Goal[] = [
  {
    scene: "model",
    can: "name mean, mode, coefficient and standard deviation in a picture, and say what ‖α‖ tells about plausibility",
  },
  {
    scene: "agree",
    can: "say what “both can make it” means: near a shape of the other model, and plausible in both",
  },
  {
    scene: "planes",
    can: "find x′, d and both likelihoods in a drawing, and say what σ is for",
  },
  {
    scene: "step",
    can: "carry out a Metropolis–Hastings step by hand, and say why no normalising constant is needed",
  },
  {
    scene: "cloud",
    can: "turn draws into a model by principal components, and predict how its error falls with their number",
  },
  {
    scene: "difference",
    can: "say why the difference has draws but no model",
  },
  {
    scene: "race",
    can: "compare samplers by effective draws, and recognise a run that must not be believed",
  },
  {
    scene: "yours",
    can: "read a comparison of two real models, and doubt it where that is due",
  },
];

export interface Part {
  minutes: number;
  scene: SceneName;
  act: string;
  /** Said to the class. */
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
        act: "Let it roam. Pause (Space), drag along α₁ alone, then α₂, then out to the third ring.",
        question: "Which of two shapes is more plausible: α = (2, 0) or (0, 2)?",
      },
      {
        minutes: 6,
        scene: "agree",
        act: "Vote by hands for each tip. Reveal. Raise σ until other tips move.",
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
        act: "Five single steps (S), told aloud. Then let it run, faster and faster; then four chains.",
        question: "The proposal is less probable. Why is it ever accepted?",
      },
      {
        minutes: 6,
        scene: "cloud",
        act: "Let the draws pile up; read the curve of the Grassmann distance.",
        question: "How many draws for half the error?",
      },
      {
        minutes: 5,
        scene: "difference",
        act: "Flip the likelihood. Look at the hole, then at the ellipse over it.",
        question: "What would principal components claim?",
      },
      {
        minutes: 3,
        scene: "race",
        act: "Start it, then break the scaling move.",
        question: "How does one notice?",
      },
      {
        minutes: 2,
        scene: "yours",
        act: "Open the heads; hand out the link.",
        question: "What is in common here, and within which σ?",
      },
    ],
  },
  {
    name: "90 minutes: with exercises in pairs",
    parts: [
      {
        minutes: 10,
        scene: "model",
        act: "As above; then pairs look for the least plausible shape that still looks like a star.",
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
        act: "Each pair another sampler; collect the Grassmann distance at 2,000 draws on the board.",
        question: "R-hat is 1.5. What do you do?",
      },
      {
        minutes: 10,
        scene: "difference",
        act: "σ from small to large; note the share of A that B cannot make.",
        question: "What is the share worth without σ?",
      },
      {
        minutes: 12,
        scene: "race",
        act: "Four groups, four ways to break it; each tells the others how one notices.",
        question: "What can a single chain not tell you?",
      },
      {
        minutes: 8,
        scene: "yours",
        act: "Heads, or models that students bring; the three questions.",
        question: "Would you publish this figure?",
      },
    ],
  },
];

/** When each part of a plan begins, in minutes. */
export function beginnings({ parts }: Plan): number[] {
  let minute = 0;
  return parts.map(({ minutes }) => {
    const begins = minute;
    minute += minutes;
    return begins;
  });
}
