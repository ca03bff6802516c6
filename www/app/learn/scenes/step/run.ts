/** Runs the scene: makes steps of the chains in the engine and keeps what is shown of them. */
import { batch, computed, signal } from "@preact/signals";
import type {
  ChainGroupProgress,
  ChainGroupSummary,
  LessonModels,
  LessonStep,
} from "../../../../worker/protocol";
import { fieldImage } from "../../canvas/plane";
import { still } from "../../clock";
import type { Ask } from "../../engine";
import { due, isTold, ONE_STEP_MS } from "../../sampling/pacing";
import { Turns } from "../../sampling/session";
import { Trail } from "../../sampling/trail";
import type { SceneValues } from "../../scenes";
import { lessonState } from "../../state";

export type StepValues = SceneValues<"step">;

/** Half width of the plane, in standard deviations. */
export const EXTENT = 3.4;
const FIELD_SIZE = 192;
/** Number of steps in the traces. */
export const TRACED = 300;
/** Number of steps that are shown with reduced motion: the chain has reached the ridge by then. */
const TELLING_STEPS = 60;
/** Largest number of steps in a request, with and without their decisions. */
const MOST_TOLD = 4000;
const MOST_AT_ONCE = 10_000;
const DIAGNOSTICS_EVERY_MS = 300;
export const MOST_STEPS = 20_000;
const GROUP = 0;
/** Settings of models with two modes, so that the plane shows all coefficients. */
const MODES = 2;
const FIRST_TWO: [number, number] = [0, 1];

export class StepRun {
  readonly models = signal<LessonModels | null>(null);
  readonly image = signal<HTMLCanvasElement | null>(null);
  readonly progress = signal<ChainGroupProgress | null>(null);
  readonly diagnostics = signal<ChainGroupSummary | null>(null);
  /** The last decision of every chain. */
  readonly decisions = signal<readonly LessonStep[]>([]);
  readonly playing = signal(false);
  /** Share of the animation of the last step. */
  readonly told = signal(1);
  readonly moving = computed(() => this.playing.value || this.told.value < 1);
  readonly trail = new Trail(TRACED);
  #ask: Ask | null = null;
  #turns = new Turns();
  #carry = 0;
  #sinceDiagnostics = 0;
  #over: ((step: number) => void) | null = null;

  /** Opens the models and goes to the step of a link; without one the animation starts. */
  async open(ask: Ask, values: StepValues, over: (step: number) => void): Promise<void> {
    const { pair, sigma, side, sampler, chains, seed, steps } = values;
    this.playing.value = false;
    const models = await ask({ ask: "open", pair, sigma, modes: MODES });
    const grid = { side, modes: FIRST_TWO, at: [], extent: EXTENT, size: FIELD_SIZE };
    const field = await ask({ ask: "field", of: "intersection", ...grid });
    const target = "intersection" as const;
    const group = { group: GROUP, target, side, sampler, chains, seed, burnIn: 0 };
    const { states } = await ask({ ask: "begin", ...group });
    this.trail.clear(states.length);
    this.trail.push(states);
    batch(() => {
      this.#ask = ask;
      this.#over = over;
      this.models.value = models;
      this.image.value = fieldImage(field);
      this.progress.value = null;
      this.diagnostics.value = null;
      this.decisions.value = [];
      this.told.value = 1;
    });
    const start = steps > 0 ? steps : still.peek() ? TELLING_STEPS : 0;
    if (start > 0) await this.#goTo(start, chains);
    batch(() => {
      lessonState.value = "done";
      this.playing.value = start === 0;
    });
  }

  /** Makes the steps that are due after a frame. */
  frame(elapsedMs: number, perSecond: number): void {
    const told = isTold(perSecond);
    const time = this.playing.peek() && told ? 1000 / perSecond : ONE_STEP_MS;
    if (this.told.peek() < 1) {
      this.told.value = told ? Math.min(1, this.told.peek() + elapsedMs / time) : 1;
      if (this.told.peek() < 1 || !this.playing.peek()) return;
    }
    if (!this.playing.peek() || this.#turns.busy) return;
    this.#sinceDiagnostics += elapsedMs;
    if (told) {
      this.#turns.take(async () => {
        await this.#advance(1);
        if (this.playing.peek()) this.told.value = 0;
        await this.#look();
      });
      return;
    }
    const most = Math.max(1, Math.floor(MOST_TOLD / this.#chains));
    const { steps, carry } = due(this.#carry, elapsedMs, perSecond, most);
    this.#carry = carry;
    if (steps === 0) return;
    this.#turns.take(async () => {
      await this.#advance(steps);
      if (this.#sinceDiagnostics > DIAGNOSTICS_EVERY_MS) await this.#look();
    });
  }

  /** Pauses; resolves to the present step when its diagnostics are computed. */
  async pause(): Promise<number> {
    this.playing.value = false;
    await this.#turns.idle();
    this.told.value = 1;
    await this.#look();
    return this.step;
  }

  /** Continues; `over` gets the last step. */
  run(over: (step: number) => void): void {
    this.#over = over;
    if (this.step < MOST_STEPS) this.playing.value = true;
  }

  /** Makes a single step, animated in phases. */
  async one(): Promise<number> {
    this.playing.value = false;
    await this.#turns.idle();
    this.#turns.take(async () => {
      await this.#advance(1);
      this.told.value = still.peek() ? 1 : 0;
      await this.#look();
    });
    await this.#turns.idle();
    return this.step;
  }

  get step(): number {
    return this.progress.peek()?.step ?? 0;
  }

  get #chains(): number {
    const width = this.progress.peek()?.states.length ?? MODES;
    return Math.max(1, width / MODES);
  }

  /** Makes many steps; only the last ones are returned with their states, for the traces. */
  async #goTo(step: number, chains: number): Promise<void> {
    const watched = Math.min(step, TRACED, Math.floor(MOST_TOLD / chains));
    for (let left = step - watched; left > 0; left -= MOST_AT_ONCE) {
      await this.#ask?.({
        ask: "advance",
        group: GROUP,
        steps: Math.min(left, MOST_AT_ONCE),
        watch: false,
      });
    }
    await this.#advance(watched);
    await this.#look();
  }

  async #advance(steps: number): Promise<void> {
    const wanted = Math.min(steps, MOST_STEPS - this.step);
    const progress = await this.#ask?.({
      ask: "advance",
      group: GROUP,
      steps: wanted,
      watch: true,
    });
    if (!progress) return;
    const chains = progress.states.length / MODES;
    const decided = progress.steps;
    for (let at = 0; at + chains <= decided.length; at += chains) {
      this.trail.push(decided.slice(at, at + chains).flatMap(stateAfter));
    }
    batch(() => {
      this.progress.value = { ...progress, steps: [] };
      if (decided.length > 0) this.decisions.value = decided.slice(-chains);
      if (progress.ended || progress.step >= MOST_STEPS) this.#end();
    });
  }

  #end(): void {
    if (!this.playing.peek()) return;
    this.playing.value = false;
    void this.pause().then((step) => this.#over?.(step));
  }

  async #look(): Promise<void> {
    this.#sinceDiagnostics = 0;
    if (this.step === 0) return;
    const diagnostics = await this.#ask?.({ ask: "summary", group: GROUP });
    if (diagnostics) this.diagnostics.value = diagnostics;
  }
}

export function stateAfter({ from, proposal, accepted }: LessonStep): number[] {
  return accepted ? proposal : from;
}
