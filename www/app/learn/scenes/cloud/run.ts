/** Runs the scene: samples the intersection from both models and computes the model of the draws. */
import { batch, computed, signal } from "@preact/signals";
import type {
  ChainGroupSummary,
  LessonIntersection,
  LessonModels,
  Side,
} from "../../../../worker/protocol";
import { still } from "../../clock";
import type { Ask } from "../../engine";
import { countsUpTo, stagesOf } from "../../sampling/pacing";
import { Turns } from "../../sampling/session";
import { type SceneValues, WALKS } from "../../scenes";
import { lessonState } from "../../state";

export type CloudValues = SceneValues<"cloud">;

/** Burn-in of the samplers: random walks start at any shape, the others at draws of the fit. */
const BURN_IN = { walks: 500, others: 50 };
const MOST_AT_ONCE = 10_000;
/** Milliseconds of a stage of the animation. */
const STAGE_MS = 420;
const STARS_SHOWN = 150;
export const MOST_DRAWS = 20_000;
/** Factor by which the number of draws grows when more are requested. */
const MORE = 4;
const SIDES = ["a", "b"] as const;
/** Milliseconds of an oscillation of the model along its first mode. */
const SWAY_MS = 4200;

export type Sides<T> = Record<Side, T>;

export class CloudRun {
  readonly models = signal<LessonModels | null>(null);
  readonly stars = signal<Sides<Float32Array> | null>(null);
  readonly found = signal<LessonIntersection | null>(null);
  readonly diagnostics = signal<Sides<ChainGroupSummary> | null>(null);
  /** Draws of each model so far. */
  readonly draws = signal(0);
  readonly playing = signal(false);
  /** Position of the oscillation, between −1 and 1. */
  readonly sway = signal(0);
  readonly #held = signal(false);
  readonly moving = computed(
    () => this.playing.value || (!still.value && !this.#held.value && this.found.value !== null),
  );
  #ask: Ask | null = null;
  #turns = new Turns();
  #values: CloudValues | null = null;
  #stages: number[] = [];
  #clock = 0;
  #angle = 0;
  #over: ((draws: number) => void) | null = null;

  /** Opens the models and makes the burn-in; then draws all at once, or animated. */
  async open(ask: Ask, values: CloudValues, growing: boolean): Promise<void> {
    const { pair, sigma, sampler, chains, seed, draws } = values;
    this.playing.value = false;
    const models = await ask({ ask: "open", pair, sigma });
    const burnIn = this.#isWalk(sampler) ? BURN_IN.walks : BURN_IN.others;
    for (const [group, side] of SIDES.entries()) {
      const target = "intersection" as const;
      await ask({ ask: "begin", group, target, side, sampler, chains, seed, burnIn });
      await ask({ ask: "advance", group, steps: burnIn, watch: false });
    }
    this.#ask = ask;
    this.#values = values;
    const stages = stagesOf(draws, chains);
    this.#over = null;
    this.#stages = growing ? stages : stages.slice(-1);
    this.draws.value = 0;
    this.models.value = models;
    this.#held.value = false;
    await this.#nextStage();
    batch(() => {
      this.playing.value = this.#stages.length > 0;
      if (!this.playing.value) lessonState.value = "done";
    });
  }

  frame(elapsedMs: number): void {
    if (!still.peek() && !this.#held.peek()) {
      this.#angle += (elapsedMs / SWAY_MS) * 2 * Math.PI;
      this.sway.value = Math.sin(this.#angle);
    }
    if (!this.playing.peek()) return;
    this.#clock += elapsedMs;
    if (this.#clock < STAGE_MS || this.#turns.busy) return;
    this.#clock = 0;
    this.#turns.take(() => this.#nextStage());
  }

  /** Stops the animation; resolves to the present number of draws. */
  async pause(): Promise<number> {
    this.playing.value = false;
    this.#held.value = true;
    await this.#turns.idle();
    this.#stages = [];
    lessonState.value = "done";
    return this.draws.peek();
  }

  /** Draws more; `over` gets the final number. */
  run(over: (draws: number) => void): void {
    this.#over = over;
    const { chains, draws: asked } = this.#values ?? { chains: 1, draws: 0 };
    const now = this.draws.peek();
    this.#held.value = false;
    if (now >= MOST_DRAWS) return;
    const target = now < asked && asked <= MOST_DRAWS ? asked : Math.min(MOST_DRAWS, MORE * now);
    this.#stages = stagesOf(target, chains).filter((stage) => stage > now);
    this.playing.value = this.#stages.length > 0;
  }

  #isWalk(sampler: string): boolean {
    return WALKS.some((walk) => walk === sampler);
  }

  async #nextStage(): Promise<void> {
    const [count, ask, values] = [this.#stages.shift(), this.#ask, this.#values];
    if (count === undefined || !ask || !values) return;
    const steps = (count - this.draws.peek()) / values.chains;
    for (const group of SIDES.keys()) {
      for (let left = steps; left > 0; left -= MOST_AT_ONCE) {
        await ask({
          ask: "advance",
          group,
          steps: Math.min(left, MOST_AT_ONCE),
          watch: false,
        });
      }
    }
    // The requested number of draws, as on the command line, not its multiple of the number of chains.
    const isLast = this.#stages.length === 0;
    const said = isLast && Math.ceil(values.draws / values.chains) * values.chains === count;
    const counts = countsUpTo(said ? values.draws : count);
    const found = await ask({ ask: "intersection", groups: [0, 1], counts });
    const stars = await Promise.all(
      SIDES.map((side, group) => ask({ ask: "shapes", group, side, most: STARS_SHOWN })),
    );
    const diagnostics = await Promise.all(SIDES.map((_, group) => ask({ ask: "summary", group })));
    const [a, b] = stars;
    const [ofA, ofB] = diagnostics;
    batch(() => {
      this.draws.value = count;
      this.found.value = found;
      if (a && b) this.stars.value = { a: a.values, b: b.values };
      if (ofA && ofB) this.diagnostics.value = { a: ofA, b: ofB };
      if (isLast) {
        this.playing.value = false;
        lessonState.value = "done";
      }
    });
    if (isLast) this.#over?.(count);
    if (isLast) this.#over = null;
  }
}
