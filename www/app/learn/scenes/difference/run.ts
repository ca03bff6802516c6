/** The difference of a side: fields, exact draws, and what PCA makes of them. */
import { batch, computed, signal } from "@preact/signals";
import type {
  LaneFigures,
  LessonField,
  LessonLaw,
  LessonModels,
  LessonPrincipal,
  LessonSide,
} from "../../../../worker/lessons";
import { still } from "../../clock";
import type { Ask } from "../../engine";
import { rained } from "../../sampling/pacing";
import type { SceneValues } from "../../scenes";
import { lessonState } from "../../state";

export type DifferenceValues = SceneValues<"difference">;

export const EXTENT = 3.4;
/** Odd: one column of the grid is at 0, for the cut. */
const FIELD_SIZE = 161;
const MODES = 2;
const FIRST_TWO: [number, number] = [0, 1];
const LANES = { difference: 0, intersection: 1 };
/** Draws of the intersection, to compare with. */
const OTHERS = { chains: 4, burnIn: 50, steps: 150 };
const FLIP_MS = 1100;
const RAIN_MS = 6000;
/** The likelihood flips by itself once it has been seen as it was. */
const STORY_MS = 3200;
/** As far as the slider goes. */
const SIGMAS = [0.003, 0.01, 0.03, 0.06, 0.1, 0.17, 0.3, 0.5, 0.8, 1.3, 2, 3];
const SHARE_DRAWS = 1500;

export interface Cloud {
  /** Two coefficients each. */
  values: Float32Array;
  law: LessonLaw;
}

export interface Found {
  models: LessonModels;
  intersection: LessonField;
  difference: LessonField;
  likelihood: LessonField;
  common: Cloud;
  exclusive: Cloud;
  figures: LaneFigures;
  principal: LessonPrincipal;
}

export interface Share {
  sigma: number;
  share: number;
}

export class DifferenceRun {
  readonly found = signal<Found | null>(null);
  /** The share that the other model cannot make, over σ. */
  readonly shares = signal<readonly Share[]>([]);
  #sharesOf = "";
  /** 0: L_D; 1: 1 − L_D; between them while it flips. */
  readonly flip = signal(0);
  /** Which of them it goes to. */
  readonly flipped = signal(false);
  /** Milliseconds of rain so far. */
  readonly rain = signal(RAIN_MS);
  readonly raining = signal(false);
  readonly #story = signal(0);
  readonly moving = computed(
    () =>
      this.raining.value || this.#story.value > 0 || this.flip.value !== Number(this.flipped.value),
  );

  async open(ask: Ask, values: DifferenceValues, told: boolean): Promise<void> {
    const { pair, sigma, side, seed, draws } = values;
    const models = await ask({ ask: "open", pair, sigma, modes: MODES });
    const grid = { side, modes: FIRST_TWO, at: [], extent: EXTENT, size: FIELD_SIZE };
    const intersection = await ask({ ask: "field", of: "intersection", ...grid });
    const difference = await ask({ ask: "field", of: "difference", ...grid });
    const likelihood = await ask({ ask: "field", of: "likelihood", ...grid });
    const lane = LANES.difference;
    await ask({
      ask: "begin",
      lane,
      target: "difference",
      side,
      sampler: "rejection",
      chains: 1,
      seed,
      burnIn: 0,
    });
    await ask({ ask: "advance", lane, steps: draws, watch: false });
    const figures = await ask({ ask: "figures", lane });
    const principal = await ask({ ask: "principal", lane });
    const { values: exclusive } = await ask({ ask: "draws", lane, most: draws });
    const common = await commonDraws(ask, values);
    batch(() => {
      this.found.value = {
        models,
        intersection,
        difference,
        likelihood,
        common,
        exclusive: { values: exclusive, law: principal },
        figures,
        principal,
      };
      lessonState.value = "done";
      if (told) this.#tell();
    });
    await this.#sweep(ask, values);
  }

  /** Other models are opened for it: after everything else. */
  async #sweep(ask: Ask, { pair, side, seed }: DifferenceValues): Promise<void> {
    const what = [pair, side, seed].join();
    if (this.#sharesOf === what) return;
    const shares: Share[] = [];
    for (const sigma of SIGMAS) {
      await ask({ ask: "open", pair, sigma, modes: MODES });
      const share = await exclusiveShare(ask, side, seed);
      if (share !== null) shares.push({ sigma, share });
    }
    this.shares.value = shares;
    this.#sharesOf = what;
  }

  /** From the start: rain on the likelihood as it was, then the flip. */
  #tell(): void {
    if (still.peek()) {
      this.turn(true);
      return;
    }
    this.#story.value = STORY_MS;
    this.startRain();
  }

  startRain(): void {
    this.rain.value = 0;
    this.raining.value = true;
  }

  toggleRain(): void {
    if (this.raining.peek()) this.raining.value = false;
    else if (this.rain.peek() < RAIN_MS) this.raining.value = true;
    else this.startRain();
  }

  /** Flips; what told itself is over. */
  turn(flipped: boolean): void {
    this.#story.value = 0;
    if (this.flipped.peek() === flipped) return;
    this.flipped.value = flipped;
    if (still.peek()) this.flip.value = Number(flipped);
    else this.startRain();
  }

  /** As a link has it: no movement. */
  place(flipped: boolean): void {
    this.#story.value = 0;
    this.flipped.value = flipped;
    this.flip.value = Number(flipped);
  }

  frame(elapsedMs: number): void {
    const goal = Number(this.flipped.peek());
    const way = goal - this.flip.peek();
    if (way !== 0) {
      const next = this.flip.peek() + Math.sign(way) * (elapsedMs / FLIP_MS);
      this.flip.value = Math.min(1, Math.max(0, next));
      if (Math.sign(goal - this.flip.peek()) !== Math.sign(way)) this.flip.value = goal;
    }
    if (this.raining.peek()) {
      this.rain.value = Math.min(RAIN_MS, this.rain.peek() + elapsedMs);
      if (this.rain.peek() === RAIN_MS) this.raining.value = false;
    }
    if (this.#story.peek() > 0) {
      this.#story.value = Math.max(0, this.#story.peek() - elapsedMs);
      if (this.#story.peek() === 0) this.turn(true);
    }
  }

  /** How many of `count` draws have fallen. */
  fallen(count: number): number {
    return rained(this.rain.value / RAIN_MS, count);
  }
}

async function exclusiveShare(ask: Ask, side: LessonSide, seed: string): Promise<number | null> {
  const lane = LANES.difference;
  const sampler = "rejection" as const;
  await ask({
    ask: "begin",
    lane,
    target: "difference",
    side,
    sampler,
    chains: 1,
    seed,
    burnIn: 0,
  });
  await ask({ ask: "advance", lane, steps: SHARE_DRAWS, watch: false });
  return (await ask({ ask: "figures", lane })).probability;
}

async function commonDraws(ask: Ask, { side, seed }: DifferenceValues): Promise<Cloud> {
  const lane = LANES.intersection;
  const { chains, burnIn, steps } = OTHERS;
  const sampler = "independence" as const;
  await ask({ ask: "begin", lane, target: "intersection", side, sampler, chains, seed, burnIn });
  await ask({ ask: "advance", lane, steps: burnIn + steps, watch: false });
  const { values } = await ask({ ask: "draws", lane, most: chains * steps });
  const law = await ask({ ask: "figures", lane });
  // Chain after chain: in turn, so that it rains everywhere at once.
  const mixed = new Float32Array(values.length);
  const count = values.length / MODES;
  for (let i = 0; i < count; i += 1) {
    const from = (i % chains) * Math.floor(count / chains) + Math.floor(i / chains);
    mixed.set(values.subarray(MODES * from, MODES * (from + 1)), MODES * i);
  }
  return { values: mixed, law };
}
