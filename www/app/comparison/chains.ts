/** Mean, variance and split R-hat of Markov chains, and the chain that differs most from the others. Pure. */

export interface Spread {
  mean: number;
  variance: number;
}

export function spreadOf(values: readonly number[]): Spread {
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  const squares = values.reduce((sum, value) => sum + (value - mean) ** 2, 0);
  return { mean, variance: squares / Math.max(1, values.length - 1) };
}

export const average = (values: readonly number[]) =>
  values.reduce((sum, value) => sum + value, 0) / values.length;

export function halvesOf(chain: readonly number[]): [number[], number[]] {
  const half = Math.floor(chain.length / 2);
  return [chain.slice(0, half), chain.slice(chain.length - half)];
}

/** Split R-hat without ranks: Gelman et al., Bayesian Data Analysis, 3rd edition, 11.4. */
export function splitRHat(chains: readonly (readonly number[])[]): number {
  const halves = chains.flatMap(halvesOf);
  const size = halves[0]?.length ?? 0;
  const spreads = halves.map(spreadOf);
  const within = average(spreads.map(({ variance }) => variance));
  const between = spreadOf(spreads.map(({ mean }) => mean)).variance;
  if (between === 0) return 1;
  return Math.sqrt((size - 1) / size + between / within);
}

/** By how much one chain differs from the others, in standard deviations within chains. */
export interface Oddity {
  kind: "apart" | "wanders" | "spread";
  chain: number;
  size: number;
  /** Its standard deviation over that within the chains, for “spread”. */
  ratio: number;
}

export function oddest(chains: readonly (readonly number[])[]): Oddity {
  const spreads = chains.map(spreadOf);
  const within = Math.sqrt(average(spreads.map(({ variance }) => variance))) || Number.MIN_VALUE;
  const all = spreads.reduce((sum, { mean }) => sum + mean, 0);
  const found = chains.flatMap((chain, index): Oddity[] => {
    const { mean, variance } = spreads[index] ?? { mean: 0, variance: 0 };
    const others = (all - mean) / Math.max(1, chains.length - 1);
    const [early, late] = halvesOf(chain).map((half) => spreadOf(half).mean);
    const ratio = Math.sqrt(variance) / within;
    const oddity = (kind: Oddity["kind"], size: number): Oddity => ({
      kind,
      chain: index,
      size,
      ratio,
    });
    return [
      oddity("apart", Math.abs(mean - others) / within),
      oddity("wanders", Math.abs((late ?? 0) - (early ?? 0)) / within),
      oddity("spread", Math.abs(Math.log(Math.max(ratio, 1e-9)))),
    ];
  });
  return found.reduce((one, other) => (other.size > one.size ? other : one));
}
