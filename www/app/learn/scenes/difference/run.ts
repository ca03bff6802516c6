/** The story of the difference: rain, the flip, rain again. */
import { batch, computed, signal } from "@preact/signals";
import { still } from "../../clock";
import type { Ask } from "../../engine";
import { rained } from "../../sampling/pacing";
import { lessonState } from "../../state";
import { type DifferenceValues, type Found, findDifference, type Share, sharesOver } from "./asks";

const FLIP_MS = 1100;
const RAIN_MS = 6000;
/** The likelihood flips by itself once it has been seen as it was. */
const STORY_MS = 3200;
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
    const found = await findDifference(ask, values);
    batch(() => {
      this.found.value = found;
      lessonState.value = "done";
      if (told) this.#tell();
    });
    await this.#sweep(ask, values);
  }

  /** Other models are opened for it: after everything else. */
  async #sweep(ask: Ask, values: DifferenceValues): Promise<void> {
    const { pair, side, seed } = values;
    const what = [pair, side, seed].join();
    if (this.#sharesOf === what) return;
    this.shares.value = await sharesOver(ask, values);
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
  show(flipped: boolean): void {
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
