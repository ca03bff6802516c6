/** Where chains have been of late: the last so many of their states, and no more memory than that. Pure. */
export class Trail {
  readonly capacity: number;
  #values = new Float64Array(0);
  #width = 0;
  #pushed = 0;

  constructor(capacity: number) {
    this.capacity = capacity;
  }

  /** Forgets everything; from now on a state has `width` numbers (chains × q). */
  clear(width: number): void {
    if (width !== this.#width) this.#values = new Float64Array(width * this.capacity);
    this.#width = width;
    this.#pushed = 0;
  }

  push(states: ArrayLike<number>): void {
    this.#values.set(states, (this.#pushed % this.capacity) * this.#width);
    this.#pushed += 1;
  }

  /** How many states it holds. */
  get length(): number {
    return Math.min(this.#pushed, this.capacity);
  }

  /** How many it has ever been given. */
  get pushed(): number {
    return this.#pushed;
  }

  /** Number `column` of the `i`-th state, the oldest first. */
  at(i: number, column: number): number {
    const slot = (this.#pushed - this.length + i) % this.capacity;
    return this.#values[slot * this.#width + column] ?? 0;
  }
}
