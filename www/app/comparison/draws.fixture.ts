/** Made-up draws for tests of plots and advice. */
import type { ChainPlots } from "../../worker/protocol";

/** Pseudo-random numbers of N(0, 1), always the same. */
export function normals(seed: number): () => number {
  let state = seed >>> 0 || 1;
  const uniform = () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return (state + 0.5) / 2 ** 32;
  };
  return () => Math.sqrt(-2 * Math.log(uniform())) * Math.cos(2 * Math.PI * uniform());
}

export function independent(chains: number, length: number, seed = 1): number[][] {
  const draw = normals(seed);
  return Array.from({ length: chains }, () => Array.from({ length }, draw));
}

/** Diagnostics of given chains as the engine computes them; the autocorrelation is given. */
export function diagnosticsOf(
  chains: number[][],
  autocorrelation: number[] = [1, 0],
  distances: number[][] = chains,
): ChainPlots {
  const length = chains[0]?.length ?? 0;
  const bins = Math.min(20, Math.max(1, Math.floor(length / 8)));
  const all = chains.flat();
  const order = all.map((_, i) => i).sort((one, other) => (all[one] ?? 0) - (all[other] ?? 0));
  const ranks = new Uint32Array(chains.length * bins);
  order.forEach((draw, rank) => {
    const bar = Math.floor(draw / length) * bins + Math.floor((rank * bins) / all.length);
    ranks[bar] = (ranks[bar] ?? 0) + 1;
  });
  return {
    chains: chains.length,
    length,
    every: 1,
    draws: Float32Array.from(all),
    distances: Float32Array.from(distances.flat()),
    bins,
    ranks,
    autocorrelation: Float32Array.from(autocorrelation),
  };
}
