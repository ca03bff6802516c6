/** Requests the data of the scene: densities, exact draws of the difference, and their PCA. */
import type {
  ChainGroupSummary,
  LessonField,
  LessonModels,
  LessonPrincipal,
  Moments,
  Side,
} from "../../../../worker/protocol";
import type { Ask } from "../../engine";
import type { SceneValues } from "../../scenes";

export type DifferenceValues = SceneValues<"difference">;

export const EXTENT = 3.4;
/** Size of the grid; odd, so that one column is at 0, for the cut. */
const FIELD_SIZE = 161;
const MODES = 2;
const FIRST_TWO: [number, number] = [0, 1];
const GROUPS = { difference: 0, intersection: 1 };
/** Number of draws of the intersection. */
const OTHERS = { chains: 4, burnIn: 50, steps: 150 };
/** Range of σ, that of the slider. */
const SIGMAS = [0.003, 0.01, 0.03, 0.06, 0.1, 0.17, 0.3, 0.5, 0.8, 1.3, 2, 3];
const SHARE_DRAWS = 1500;

export interface Cloud {
  /** Two coefficients of each draw. */
  values: Float32Array;
  gaussian: Moments;
}

export interface Found {
  models: LessonModels;
  intersection: LessonField;
  difference: LessonField;
  likelihood: LessonField;
  common: Cloud;
  exclusive: Cloud;
  diagnostics: ChainGroupSummary;
  principal: LessonPrincipal;
}

export interface Share {
  sigma: number;
  share: number;
}

export async function findDifference(ask: Ask, values: DifferenceValues): Promise<Found> {
  const { pair, sigma, side, seed, draws } = values;
  const models = await ask({ ask: "open", pair, sigma, modes: MODES });
  const grid = { side, modes: FIRST_TWO, at: [], extent: EXTENT, size: FIELD_SIZE };
  const intersection = await ask({ ask: "field", of: "intersection", ...grid });
  const difference = await ask({ ask: "field", of: "difference", ...grid });
  const likelihood = await ask({ ask: "field", of: "likelihood", ...grid });
  const group = GROUPS.difference;
  await ask({
    ask: "begin",
    group,
    target: "difference",
    side,
    sampler: "rejection",
    chains: 1,
    seed,
    burnIn: 0,
  });
  await ask({ ask: "advance", group, steps: draws, watch: false });
  const diagnostics = await ask({ ask: "summary", group });
  const principal = await ask({ ask: "principal", group });
  const { values: exclusive } = await ask({ ask: "draws", group, most: draws });
  const common = await commonDraws(ask, values);
  return {
    models,
    intersection,
    difference,
    likelihood,
    common,
    exclusive: { values: exclusive, gaussian: principal },
    diagnostics,
    principal,
  };
}

/** Computes the share of the difference over σ. Opens the models again for every σ, so it is called last. */
export async function sharesOver(
  ask: Ask,
  { pair, side, seed }: DifferenceValues,
): Promise<Share[]> {
  const shares: Share[] = [];
  for (const sigma of SIGMAS) {
    await ask({ ask: "open", pair, sigma, modes: MODES });
    const share = await exclusiveShare(ask, side, seed);
    if (share !== null) shares.push({ sigma, share });
  }
  return shares;
}

async function exclusiveShare(ask: Ask, side: Side, seed: string): Promise<number | null> {
  const group = GROUPS.difference;
  const sampler = "rejection" as const;
  await ask({
    ask: "begin",
    group,
    target: "difference",
    side,
    sampler,
    chains: 1,
    seed,
    burnIn: 0,
  });
  await ask({ ask: "advance", group, steps: SHARE_DRAWS, watch: false });
  return (await ask({ ask: "summary", group })).probability;
}

async function commonDraws(ask: Ask, { side, seed }: DifferenceValues): Promise<Cloud> {
  const group = GROUPS.intersection;
  const { chains, burnIn, steps } = OTHERS;
  const sampler = "independence" as const;
  await ask({
    ask: "begin",
    group,
    target: "intersection",
    side,
    sampler,
    chains,
    seed,
    burnIn,
  });
  await ask({ ask: "advance", group, steps: burnIn + steps, watch: false });
  const { values } = await ask({ ask: "draws", group, most: chains * steps });
  const gaussian = await ask({ ask: "summary", group });
  // Interleaves the chains, so that the dots appear everywhere at once.
  const mixed = new Float32Array(values.length);
  const count = values.length / MODES;
  for (let i = 0; i < count; i += 1) {
    const from = (i % chains) * Math.floor(count / chains) + Math.floor(i / chains);
    mixed.set(values.subarray(MODES * from, MODES * (from + 1)), MODES * i);
  }
  return { values: mixed, gaussian };
}
