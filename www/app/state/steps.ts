/**
 * Keeps the steps of undo in the browser's history, so that Undo is Back and never leaves the page.
 *
 * The browser does not tell how many entries there are in either direction, so every entry has a number, and state
 * that no address can hold is kept here under that number. Entries from before a reload have numbers, too, which are
 * no longer valid.
 */
import { computed, signal } from "@preact/signals";

export type Entries = Pick<History, "state" | "pushState" | "replaceState" | "go">;

/** Data of an entry of the history. */
interface Mark {
  life: number;
  step: number;
}

export class Steps<Snapshot> {
  #entries: Entries;
  #life: number;
  #snapshots = new Map<number, Snapshot>();
  #at = signal(0);
  #top = signal(0);
  /** Whether the browser is going to another entry. */
  #travelling = false;
  /** Steps that were requested meanwhile. */
  #queued = 0;

  readonly undoable = computed(() => this.#at.value > 0);
  readonly redoable = computed(() => this.#at.value < this.#top.value);

  /** `life` distinguishes this page from the same page before a reload. */
  constructor(entries: Entries, life: number) {
    this.#entries = entries;
    this.#life = life;
  }

  /** The number of the present step. */
  get at(): number {
    return this.#at.peek();
  }

  /** Makes the present entry the first step. */
  begin(snapshot: Snapshot): void {
    this.#snapshots.set(0, snapshot);
    this.#entries.replaceState(this.#mark(0), "");
  }

  push(snapshot: Snapshot, address: string): void {
    const step = this.#at.peek() + 1;
    this.#at.value = step;
    this.#top.value = step;
    this.#snapshots.set(step, snapshot);
    this.#entries.pushState(this.#mark(step), "", address);
  }

  /** Changes the present step, so that the change is undone with it. */
  join(snapshot: Snapshot, address: string): void {
    this.#snapshots.set(this.#at.peek(), snapshot);
    this.#entries.replaceState(this.#mark(this.#at.peek()), "", address);
  }

  undo(): void {
    this.#travel(-1);
  }

  redo(): void {
    this.#travel(1);
  }

  /** Handles the arrival at an entry: returns its snapshot; null if only its address is known. */
  arrive(state: unknown): Snapshot | null {
    this.#travelling = false;
    const mark = state as Mark | null;
    if (mark?.life === this.#life) this.#at.value = mark.step;
    else if (mark) {
      // An entry from before a reload, or after one: nothing can be undone from there.
      this.#at.value = 0;
    } else {
      // Somebody typed another address.
      const step = this.#at.peek() + 1;
      this.#at.value = step;
      this.#top.value = step;
      this.#snapshots.delete(step);
      this.#entries.replaceState(this.#mark(step), "");
    }
    if (this.#queued !== 0) this.#leap();
    return mark?.life === this.#life ? (this.#snapshots.get(mark.step) ?? null) : null;
  }

  /** Goes through the history one call at a time: browsers drop all but one of several at once. */
  #travel(by: 1 | -1): void {
    this.#queued += by;
    if (!this.#travelling) this.#leap();
  }

  #leap(): void {
    const [at, top] = [this.#at.peek(), this.#top.peek()];
    const by = Math.max(-at, Math.min(top - at, this.#queued));
    this.#queued = 0;
    if (by === 0) return;
    this.#travelling = true;
    this.#entries.go(by);
  }

  #mark(step: number): Mark {
    return { life: this.#life, step };
  }
}
