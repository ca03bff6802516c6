/** Questions for a class, each with its answer and a link to a scene that shows it. */
import type { ComponentChildren } from "preact";
import type { SceneName } from "../../scenes";

export interface Question {
  scene: SceneName;
  /** Keys of the scene's link that differ from the defaults. */
  link: string;
  ask: ComponentChildren;
  answer: ComponentChildren;
}

export const QUESTIONS: readonly Question[] = [
  {
    scene: "model",
    link: "coefficients=2,0",
    ask: "Two shapes of one model: α = (2, 0) and α = (0, 2). Which is more plausible?",
    answer: (
      <>
        Neither. p(α) ∝ exp(−½‖α‖²) depends on ‖α‖ alone, and both are 2 standard deviations away.
        In units of the star the first is further from the mean, since √λ₁&nbsp;&gt;&nbsp;√λ₂.
      </>
    ),
  },
  {
    scene: "model",
    link: "coefficients=0,0",
    ask: "The mean is the most probable shape. Are most shapes of a model with 50 modes near it?",
    answer: (
      <>
        No. ‖α‖² is χ² distributed with 50 degrees of freedom, so ‖α‖ is about √50 ≈ 7 for nearly
        all shapes. The density is highest at the mean, but there is hardly any volume near it.
      </>
    ),
  },
  {
    scene: "agree",
    link: "shown=yes",
    ask: "A and B have four modes each. How many does A∩B need?",
    answer: (
      <>
        Two: one for the sweep of the common tip, and a small one because a tip that moves on a
        circle does not move on a straight line. What else the method finds is only as large as σ
        allows.
      </>
    ),
  },
  {
    scene: "agree",
    link: "shown=yes",
    ask: "Let A and B be the same model. Is A∩B that model?",
    answer: (
      <>
        Almost: the same mean and modes, but half the variance. Then d = 0 everywhere and α′ = α,
        and exp(−½‖α‖²)·exp(−½‖α′‖²) = exp(−‖α‖²), a normal distribution of variance ½.
      </>
    ),
  },
  {
    scene: "planes",
    link: "coefficients=-2.5,0",
    ask: "x lies exactly on the line where the planes meet, but far from both means. Does it belong to A∩B?",
    answer: (
      <>
        It is near, d = 0 and L<sub>D</sub> = 1, but not plausible: ‖α‖ or ‖α′‖ is large. An
        intersection of planes goes on for ever; one of allowable domains does not.
      </>
    ),
  },
  {
    scene: "planes",
    link: "tilt=0&lift=0.8",
    ask: "Parallel planes never meet. What does the method return, and how can one detect it?",
    answer: (
      <>
        d is the same everywhere, so L<sub>D</sub> is a constant factor, and constants cancel in
        every ratio that a sampler looks at. It returns the shapes that are plausible in both as if
        they were common. The mean d compared with σ shows it: here 0.8 against 0.3.
      </>
    ),
  },
  {
    scene: "step",
    link: "steps=1",
    ask: "Nobody knows the normalising constant of the target. Why does the sampler not need it?",
    answer: <>It only looks at ratios p(α*)/p(α): the constant is in both and cancels.</>,
  },
  {
    scene: "step",
    link: "steps=20",
    ask: "A proposal is less probable than where the chain is. Why is it ever accepted?",
    answer: (
      <>
        Otherwise the chain would go to the maximum and stay there, like an optimiser. Accepting
        with probability min(1, ratio) makes the time that it spends anywhere proportional to the
        density there; this follows from detailed balance.
      </>
    ),
  },
  {
    scene: "step",
    link: "steps=20",
    ask: "The scaling move keeps the direction of α and draws a new norm r′ = r + 0.2 ε. Why is it not symmetric?",
    answer: (
      <>
        It is symmetric in r, but the target is a density over α. There is more volume at a larger
        norm: the area of a sphere of radius r is proportional to r<sup>q−1</sup>. So the ratio
        needs the factor (r′/r)
        <sup>q−1</sup>. The paper leaves it out; then norms are too small, on N(0, I₅₀) to E‖α‖²/q =
        0.53 instead of 1.
      </>
    ),
  },
  {
    scene: "cloud",
    link: "draws=8000",
    ask: "You have 2,000 draws. How many for half the error of the model?",
    answer: (
      <>
        Four times as many, if they are as independent as the first: the error is proportional to
        1/√N
        <sub>eff</sub>. Neighbours in a chain resemble each other, so N<sub>eff</sub> is less than
        the count, and keeping every tenth draw alone makes nothing better.
      </>
    ),
  },
  {
    scene: "cloud",
    link: "sampler=paper-corrected",
    ask: "Eight chains, R-hat = 1.5. The model looks fine. Do you believe it?",
    answer: (
      <>
        No. The chains differ from each other more than they vary themselves: they still depend on
        where they started. Run longer, or use a better sampler; below 1.01 one may go on.
      </>
    ),
  },
  {
    scene: "difference",
    link: "flipped=yes",
    ask: "Why are there draws of the difference but no model of it?",
    answer: (
      <>
        A model is a Gaussian with a mean and a covariance, and its density is highest at the mean.
        The difference has a hole there: often the mean of its draws is itself a shape that both can
        make.
      </>
    ),
  },
  {
    scene: "difference",
    link: "sigma=0.03&flipped=yes",
    ask: "As σ goes to 0, what happens to the share of A that B cannot make?",
    answer: (
      <>
        It goes to 100 %, unless A lies within B’s plane. E[1 − L<sub>D</sub>] counts all shapes
        with d well above σ, and exact hits have probability zero. A share without its σ says
        nothing.
      </>
    ),
  },
  {
    scene: "race",
    link: "",
    ask: "Why is the independence sampler so much better, and when would it not be?",
    answer: (
      <>
        The target is log-concave and nearly Gaussian, on the stars exactly, and the sampler
        proposes from a Gaussian fitted to it: almost every proposal is accepted and does not depend
        on the one before. If the fit misses a tail of the target, a chain that gets there stays for
        very long; R-hat and the effective draws show it.
      </>
    ),
  },
  {
    scene: "race",
    link: "break=one-chain",
    ask: "What can a single chain not tell you?",
    answer: (
      <>
        Which shapes it has not reached. R-hat can then only compare its first half with its second;
        a chain that never left one region agrees with itself perfectly. Dispersed starts make
        disagreement visible.
      </>
    ),
  },
];
