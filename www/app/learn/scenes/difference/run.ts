/** Runs the scene: draws of the intersection appear, the likelihood is flipped, draws of the difference appear. */
import { batch, computed, signal } from "@preact/signals";
import { still } from "../../clock";
import type { Ask } from "../../engine";
import { rained } from "../../sampling/pacing";
import { lessonState } from "../../state";
import { type DifferenceValues, type Found, findDifference, type Share, sharesOver } from "./asks";

const FLIP_MS = 1100;
const RAIN_MS = 6000;
/** Milliseconds after which the likelihood is flipped automatically. */
const STORY_MS = 3200;
export class DifferenceRun {
  readonly found = signal<Found | null>(null);
  /** Share of the model that the other cannot make, over σ. */
  readonly shares = signal<readonly Share[]>([]);
  #sharesOf = "";
  /** 0 for L_D, 1 for 1 − L_D, between them during the flip. */
  readonly flip = signal(0);
  /** The one that it changes to. */
  readonly flipped = signal(false);
  /** Milliseconds of falling dots so far. */
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

  /** Computes the shares over σ, last, since it opens other models. */
  async #sweep(ask: Ask, values: DifferenceValues): Promise<void> {
    const { pair, side, seed } = values;
    const what = [pair, side, seed].join();
    if (this.#sharesOf === what) return;
    this.shares.value = await sharesOver(ask, values);
    this.#sharesOf = what;
  }

  /** Restarts the animation: draws of the intersection first, then the flip. */
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

  /** Flips the likelihood and ends the automatic animation. */
  turn(flipped: boolean): void {
    this.#story.value = 0;
    if (this.flipped.peek() === flipped) return;
    this.flipped.value = flipped;
    if (still.peek()) this.flip.value = Number(flipped);
    else this.startRain();
  }

  /** Shows the state of a link, without an animation. */
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

  /** Number of `count` draws that have fallen. */
  fallen(count: number): number {
    return rained(this.rain.value / RAIN_MS, count);
  }
}
