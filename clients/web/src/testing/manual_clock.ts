import type { Clock } from "../platform.js";

/** Time that stands still until it is advanced; for tests. */
export class ManualClock implements Clock {
  #nowMs = 1000;
  #timers = new Set<{ work(): void; everyMs: number; dueMs: number }>();

  nowMs(): number {
    return this.#nowMs;
  }

  setInterval(work: () => void, everyMs: number): unknown {
    const timer = { work, everyMs, dueMs: this.#nowMs + everyMs };
    this.#timers.add(timer);
    return timer;
  }

  clearInterval(timer: unknown): void {
    this.#timers.delete(timer as never);
  }

  /** Let time pass; timers run when they are due, in their order. */
  advance(ms: number): void {
    const endMs = this.#nowMs + ms;
    for (;;) {
      const next = [...this.#timers].sort((a, b) => a.dueMs - b.dueMs)[0];
      if (!next || next.dueMs > endMs) break;
      this.#nowMs = next.dueMs;
      next.dueMs += next.everyMs;
      next.work();
    }
    this.#nowMs = endMs;
  }

  /** Let time pass at once, as on a page that was asleep: timers that are due run once, at the end. */
  jump(ms: number): void {
    this.#nowMs += ms;
    for (const timer of [...this.#timers]) {
      if (timer.dueMs > this.#nowMs) continue;
      timer.dueMs = this.#nowMs + timer.everyMs;
      timer.work();
    }
  }
}
