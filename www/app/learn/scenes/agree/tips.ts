/** Sentences about the guessed tips and the tips that both models move. Pure. */
import { TIPS } from "../../shape";

/** Names of the tips of a star, the top one first, then anticlockwise. */
export const TIP_NAMES = ["top", "upper left", "lower left", "lower right", "upper right"] as const;

/** Share of the largest standard deviation of a tip below which a tip counts as fixed. */
const SEEN = 0.15;

/** Tips, from 0 to 4, that move, by the standard deviations of all points. */
export function movable(vertexSd: readonly number[]): number[] {
  const sds = TIPS.map((point) => vertexSd[point] ?? 0);
  const most = Math.max(...sds);
  return sds.flatMap((sd, tip) => (most > 0 && sd >= SEEN * most ? tip : []));
}

/** “top”, “top and lower left”, “top, lower left and lower right”. */
export function named(tips: readonly number[]): string {
  const names = tips.map((tip) => TIP_NAMES[tip] ?? "");
  const last = names.pop() ?? "no tip";
  return names.length === 0 ? last : `${names.join(", ")} and ${last}`;
}

export type Verdict = "none" | "right" | "partly" | "wrong";

export function verdictOn(guess: readonly number[], answer: readonly number[]): Verdict {
  if (guess.length === 0) return "none";
  const hits = guess.filter((tip) => answer.includes(tip)).length;
  if (hits === guess.length && hits === answer.length) return "right";
  return hits > 0 ? "partly" : "wrong";
}

const OPENINGS: Record<Verdict, string> = {
  none: "Next time, guess first.",
  right: "Right.",
  partly: "Partly right.",
  wrong: "A good guess, but no.",
};

const tipsOf = (tips: readonly number[]) => `${named(tips)} tip${tips.length > 1 ? "s" : ""}`;

/** Tips that both models can move, independent of σ. */
export function sharedTips({ a, b }: Record<"a" | "b", readonly number[]>): number[] {
  return a.filter((tip) => b.includes(tip));
}

/** The answer to a guess, with the reason. */
export function answerIn(
  guess: readonly number[],
  { a, b, both }: Record<"a" | "b" | "both", readonly number[]>,
): string {
  const shared = sharedTips({ a, b });
  const others = (tips: readonly number[]) => tips.filter((tip) => !shared.includes(tip));
  const [onlyA, onlyB, extra] = [others(a), others(b), others(both)];
  const said = [OPENINGS[verdictOn(guess, shared)]];
  said.push(`Both can move the ${tipsOf(shared)}${shared.length === 1 ? ", and no other" : ""}.`);
  if (extra.length > 0) {
    said.push(
      `But with so large a σ a star whose ${tipsOf(extra)} ${extra.length > 1 ? "have" : "has"} ` +
        "moved still counts as near.",
    );
  } else {
    if (onlyA.length > 0) {
      said.push(`Only A can move the ${tipsOf(onlyA)}: B keeps it fixed.`);
    }
    if (onlyB.length > 0) said.push(`Only B can move the ${tipsOf(onlyB)}.`);
  }
  return said.join(" ");
}
