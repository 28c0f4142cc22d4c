// Events that wait for the consumer of an async iterator. Moves of a slow one merge, edges never get lost.

import { EgoTouchError } from "../errors.js";
import { isStream, type TouchEvent } from "../events.js";

/** More events than this wait only where nobody reads any more. */
const MOST_WAITING = 1024;
/** Merged events that a move carries at most, as on the wire. */
const MOST_COALESCED = 8;

export class EventQueue implements AsyncIterableIterator<TouchEvent> {
  #waiting: TouchEvent[] = [];
  #readers: { resolve(result: IteratorResult<TouchEvent>): void; reject(error: unknown): void }[] = [];
  #end: { readonly error: EgoTouchError | null } | null = null;
  readonly #onEnd: () => void;

  constructor(onEnd: () => void) {
    this.#onEnd = onEnd;
  }

  push(event: TouchEvent): void {
    if (this.#end) return;
    const reader = this.#readers.shift();
    if (reader) reader.resolve({ value: event, done: false });
    else if (!this.#merge(event)) this.#waiting.push(event);
    if (this.#waiting.length > MOST_WAITING) {
      this.finish(new EgoTouchError("too_slow", `${this.#waiting.length} events wait to be read`, "Read faster, or end the loop with a signal"));
    }
  }

  /** End the iteration after what waits; with an error it fails then. */
  finish(error: EgoTouchError | null = null): void {
    if (this.#end) return;
    this.#end = { error };
    this.#onEnd();
    for (const { resolve, reject } of this.#readers.splice(0)) {
      if (error) reject(error);
      else resolve({ value: undefined, done: true });
    }
  }

  next(): Promise<IteratorResult<TouchEvent>> {
    const event = this.#waiting.shift();
    if (event) return Promise.resolve({ value: event, done: false });
    if (this.#end?.error) return Promise.reject(this.#end.error);
    if (this.#end) return Promise.resolve({ value: undefined, done: true });
    return new Promise((resolve, reject) => this.#readers.push({ resolve, reject }));
  }

  return(): Promise<IteratorResult<TouchEvent>> {
    this.#waiting = [];
    this.finish();
    return Promise.resolve({ value: undefined, done: true });
  }

  [Symbol.asyncIterator](): this {
    return this;
  }

  /** Merge a move with the one of the same pointer and kind that waits since the last edge. */
  #merge(event: TouchEvent): boolean {
    for (let i = this.#waiting.length - 1; i >= 0; i -= 1) {
      const older = this.#waiting[i]!;
      if (!isStream(older.type) || !isStream(event.type)) return false;
      if (older.type !== event.type || older.pointerId !== event.pointerId || older.late !== event.late) continue;
      this.#waiting.splice(i, 1);
      const coalesced = [...older.coalesced, { ...older, coalesced: [] }, ...event.coalesced].slice(-MOST_COALESCED);
      this.#waiting.push({ ...event, coalesced });
      return true;
    }
    return false;
  }
}
