/** Pauses before connecting again, in milliseconds: full jitter under a ceiling that doubles. */
const FIRST_MS = 250;
const MOST_MS = 5000;

export class BackOff {
  readonly #random: () => number;
  #attempt = 0;

  /** `random` gives numbers in [0, 1). */
  constructor(random: () => number) {
    this.#random = random;
  }

  /** The next pause. */
  next(): number {
    const ceilingMs = Math.min(MOST_MS, FIRST_MS * 2 ** this.#attempt);
    this.#attempt += 1;
    return this.#random() * ceilingMs;
  }

  /** A connection has held for `lifeMs`: one that held longer than the longest pause counts as a success. */
  heldFor(lifeMs: number): void {
    if (lifeMs > MOST_MS) this.#attempt = 0;
  }

  reset(): void {
    this.#attempt = 0;
  }
}
