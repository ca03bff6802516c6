/** The five regions of a comparison: their order, and whose shapes they have. */
import type { Differences, Region, Side } from "../../worker/protocol";

export const REGIONS: Region[] = ["a", "aWithoutB", "intersection", "bWithoutA", "b"];

export type Difference = keyof Differences;

interface About {
  kind: "model" | "difference" | "intersection";
  /** The models that have its shapes. */
  owner: Side | "both";
}

const ABOUT: Record<Region, About> = {
  a: { kind: "model", owner: "a" },
  aWithoutB: { kind: "difference", owner: "a" },
  intersection: { kind: "intersection", owner: "both" },
  bWithoutA: { kind: "difference", owner: "b" },
  b: { kind: "model", owner: "b" },
};

export function ownerOf(region: Region): About["owner"] {
  return ABOUT[region].owner;
}

export function isModel(region: Region): region is Side {
  return ABOUT[region].kind === "model";
}

export function isDifference(region: Region): region is Difference {
  return ABOUT[region].kind === "difference";
}

/** What only this model can make. */
export const DIFFERENCE_OF: Record<Side, Difference> = { a: "aWithoutB", b: "bWithoutA" };

export function otherSide(side: Side): Side {
  return side === "a" ? "b" : "a";
}

/** The letters of a model and of the other one. */
export function letters(side: Side): readonly ["A", "B"] | readonly ["B", "A"] {
  return side === "a" ? ["A", "B"] : ["B", "A"];
}
