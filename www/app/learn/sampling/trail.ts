/** Ring buffer of the last states of the chains. Pure. */
export class Trail {
  readonly capacity: number;
  #values = new Float64Array(0);
  #width = 0;
  #pushed = 0;

  constructor(capacity: number) {
    this.capacity = capacity;
  }

  /** Clears the buffer; from now on a state has `width` numbers (chains × q). */
  clear(width: number): void {
    if (width !== this.#width) this.#values = new Float64Array(width * this.capacity);
    this.#width = width;
    this.#pushed = 0;
  }

  push(states: ArrayLike<number>): void {
    this.#values.set(states, (this.#pushed % this.capacity) * this.#width);
    this.#pushed += 1;
  }

  /** Number of stored states. */
  get length(): number {
    return Math.min(this.#pushed, this.capacity);
  }

  /** Number of states that were ever added. */
  get pushed(): number {
    return this.#pushed;
  }

  /** Number `column` of the `i`-th state, the oldest first. */
  at(i: number, column: number): number {
    const slot = (this.#pushed - this.length + i) % this.capacity;
    return this.#values[slot * this.#width + column] ?? 0;
  }
}
