/**
 * Notices a worker that hangs: a panic in a pool thread makes no sound, the coordinator just
 * never comes back. Counts looks rather than time, so that a sleeping laptop is no hang.
 */
const LOOK_EVERY_MS = 1000;
const MOST_SILENT_LOOKS = 7;
const MOST_BUSY_LOOKS = 240;

export class Watch {
  #silent = 0;
  #limit = MOST_SILENT_LOOKS;
  #timer: ReturnType<typeof setInterval>;

  constructor(expectsAnswer: () => boolean, onHang: () => void) {
    this.#timer = setInterval(() => {
      if (!expectsAnswer()) {
        this.#silent = 0;
        return;
      }
      this.#silent += 1;
      if (this.#silent > this.#limit) {
        this.heard();
        onHang();
      }
    }, LOOK_EVERY_MS);
  }

  heard(): void {
    this.#silent = 0;
    this.#limit = MOST_SILENT_LOOKS;
  }

  /** Long indivisible work has begun. */
  busy(): void {
    this.#silent = 0;
    this.#limit = MOST_BUSY_LOOKS;
  }

  stop(): void {
    clearInterval(this.#timer);
  }
}
