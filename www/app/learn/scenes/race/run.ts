/** Runs the scene: several samplers on one target, with or without a failure. */
import { batch, signal } from "@preact/signals";
import type { ChainGroupSummary, LessonModels, LessonSampler } from "../../../../worker/protocol";
import { fieldImage } from "../../canvas/plane";
import type { Ask } from "../../engine";
import { due } from "../../sampling/pacing";
import { Turns } from "../../sampling/session";
import { Trail } from "../../sampling/trail";
import type { SceneValues } from "../../scenes";
import { lessonState } from "../../state";
import { broken, type View, viewOf } from "./broken";

export type RaceValues = SceneValues<"race">;

const BURN_IN = 200;
const TRAIL = 90;
const FIELD_SIZE = 144;
/** Milliseconds of the animation. */
const RACE_MS = 10_000;
/** Number of parts of a run without animation, for its curves; diagnostics of a long run are slow. */
const PARTS = { short: 25, long: 10 };
const LONG = 1000;
/** Largest number of steps between two frames. */
const MOST_AT_ONCE = 200;
const DIAGNOSTICS_EVERY_MS = 120;
/** Diagnostics take at most one part in this many of the time. */
const DIAGNOSTICS_SHARE = 4;
export const MOST_STEPS = 5000;
const MORE = 2;

export interface Runner {
  sampler: LessonSampler;
  group: number;
  dimension: number;
  /** Length of a state: chains × dimension. */
  width: number;
  trail: Trail;
}

/** Mean of ‖α‖²/q of each sampler after some steps. */
export interface Moment {
  step: number;
  meanSquares: readonly number[];
}

export class RaceRun {
  readonly models = signal<LessonModels | null>(null);
  readonly image = signal<HTMLCanvasElement | null>(null);
  readonly view = signal<View | null>(null);
  readonly runners = signal<readonly Runner[]>([]);
  readonly diagnostics = signal<readonly ChainGroupSummary[]>([]);
  readonly curve = signal<readonly Moment[]>([]);
  readonly playing = signal(false);
  /** Steps after the burn-in. */
  readonly step = signal(0);
  readonly target = signal(0);
  #ask: Ask | null = null;
  #turns = new Turns();
  #carry = 0;
  #clock = 0;
  #next = 0;
  #every = DIAGNOSTICS_EVERY_MS;
  #over: ((steps: number) => void) | null = null;

  async open(ask: Ask, values: RaceValues, growing: boolean): Promise<void> {
    const { side, chains, seed, steps } = values;
    this.playing.value = false;
    const { opening, samplers, target, dimension, oneChain } = broken(values);
    const models = await ask({ ask: "open", ...opening });
    const view = viewOf(models.fits[side], target);
    const field = await ask({
      ask: "field",
      of: target,
      side,
      modes: [0, 1],
      at: target === "normal" ? [] : models.fits[side].mean,
      extent: view.fieldExtent,
      size: FIELD_SIZE,
    });
    const runners: Runner[] = [];
    for (const [group, sampler] of samplers.entries()) {
      const begun = await ask({
        ask: "begin",
        group,
        target,
        side,
        sampler,
        chains: oneChain ? 1 : chains,
        seed,
        burnIn: BURN_IN,
        ...(dimension === null ? {} : { dimension }),
      });
      const { states } = await ask({ ask: "advance", group, steps: BURN_IN, watch: false });
      const trail = new Trail(TRAIL);
      trail.clear(states.length);
      trail.push(states);
      runners.push({ sampler, group, dimension: begun.dimension, width: states.length, trail });
    }
    batch(() => {
      this.#ask = ask;
      this.#over = null;
      this.models.value = models;
      this.view.value = view;
      this.image.value = fieldImage(field);
      this.runners.value = runners;
      this.diagnostics.value = [];
      this.curve.value = [];
      this.step.value = 0;
      this.target.value = steps;
      this.playing.value = growing;
    });
    if (!growing) await this.#jump(steps);
  }

  /** Whether curves are drawn: only if their limit is known. */
  get #curved(): boolean {
    return this.runners.peek().length === 2;
  }

  frame(elapsedMs: number): void {
    if (!this.playing.peek() || this.#turns.busy) return;
    this.#clock += elapsedMs;
    const perSecond = this.target.peek() / (RACE_MS / 1000);
    const { steps, carry } = due(this.#carry, elapsedMs, perSecond, MOST_AT_ONCE);
    this.#carry = carry;
    const left = this.target.peek() - this.step.peek();
    const now = Math.min(steps, left);
    if (now > 0) this.#turns.take(() => this.#stride(now));
  }

  /** Pauses; resolves to the number of steps made. */
  async pause(): Promise<number> {
    this.playing.value = false;
    await this.#turns.idle();
    await this.#look();
    lessonState.value = "done";
    return this.step.peek();
  }

  /** Continues to the end, or beyond it; `over` gets the number of steps. */
  run(over: (steps: number) => void): void {
    const step = this.step.peek();
    if (step >= MOST_STEPS) return;
    if (step >= this.target.peek()) this.target.value = Math.min(MOST_STEPS, MORE * step);
    this.#over = over;
    this.playing.value = true;
  }

  async #stride(steps: number): Promise<void> {
    await this.#advance(steps);
    const isOver = this.step.peek() >= this.target.peek();
    if (isOver) {
      await this.#look();
      batch(() => {
        this.playing.value = false;
        lessonState.value = "done";
      });
      this.#over?.(this.step.peek());
      this.#over = null;
    } else if (this.#clock > this.#every) {
      this.#clock = 0;
      const start = performance.now();
      await this.#lookAtNext();
      this.#every = Math.max(DIAGNOSTICS_EVERY_MS, DIAGNOSTICS_SHARE * (performance.now() - start));
    }
  }

  /** Makes the steps of a link in parts, so that the curves are complete. */
  async #jump(steps: number): Promise<void> {
    const parts = !this.#curved ? 1 : steps > LONG ? PARTS.long : PARTS.short;
    for (let part = 1; part <= parts; part += 1) {
      const goal = Math.round((steps * part) / parts);
      // The last steps one by one, for the trails.
      const single = part === parts ? Math.min(TRAIL, goal - this.step.peek()) : 0;
      const before = goal - this.step.peek() - single;
      await this.#move(before);
      for (let i = 0; i < single; i += 1) await this.#move(1);
      this.step.value = goal;
      await this.#look();
    }
    lessonState.value = "done";
  }

  async #advance(steps: number): Promise<void> {
    await this.#move(steps);
    this.step.value += steps;
  }

  /** Makes steps with every sampler; signals change once after all of them. */
  async #move(steps: number): Promise<void> {
    const ask = this.#ask;
    if (steps <= 0 || !ask) return;
    const answers = await Promise.all(
      this.runners.peek().map(({ group }) => ask({ ask: "advance", group, steps, watch: false })),
    );
    this.runners.peek().forEach(({ trail }, i) => {
      const states = answers[i]?.states;
      if (states) trail.push(states);
    });
  }

  async #look(): Promise<void> {
    const ask = this.#ask;
    if (!ask || this.step.peek() === 0) return;
    const runners = this.runners.peek();
    this.diagnostics.value = await Promise.all(
      runners.map(({ group }) => ask({ ask: "summary", group })),
    );
    this.#note();
  }

  /** Requests the diagnostics of one sampler at a time: all together would delay the animation. */
  async #lookAtNext(): Promise<void> {
    const runners = this.runners.peek();
    const ask = this.#ask;
    if (!ask) return;
    if (this.diagnostics.peek().length < runners.length) return this.#look();
    this.#next = (this.#next + 1) % runners.length;
    const diagnostics = await ask({ ask: "summary", group: this.#next });
    this.diagnostics.value = this.diagnostics
      .peek()
      .map((old, i) => (i === this.#next ? diagnostics : old));
    this.#note();
  }

  #note(): void {
    const meanSquares = this.diagnostics.peek().map(({ meanSquare }) => meanSquare);
    const step = this.step.peek();
    const before = this.curve.peek().filter((moment) => moment.step < step);
    this.curve.value = [...before, { step, meanSquares }];
  }
}
