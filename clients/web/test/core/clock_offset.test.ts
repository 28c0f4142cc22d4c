import { describe, expect, test } from "vitest";
import { ClockOffset } from "../../src/core/clock_offset.js";
import { randomNumbers } from "../support/random.js";

/** One probe at `sentMs` of a server whose clock is `offsetMs` ahead, with these delays of the two ways. */
function probe(clock: ClockOffset, sentMs: number, offsetMs: number, thereMs: number, backMs: number): void {
  const arrivedMs = sentMs + thereMs;
  clock.add({ clientSendMs: sentMs, serverReceiveMs: arrivedMs + offsetMs, serverSendMs: arrivedMs + offsetMs + 0.1, clientReceiveMs: arrivedMs + 0.1 + backMs });
}

describe("the clock offset", () => {
  test("is within 2 ms under 1 to 21 ms of delay each way, and within its own bound", () => {
    const random = randomNumbers(1);
    for (let run = 0; run < 50; run += 1) {
      const clock = new ClockOffset();
      for (let i = 0; i < 100; i += 1) probe(clock, i * 1000, 5000, 1 + 20 * random(), 1 + 20 * random());
      const errorMs = Math.abs(clock.offsetMs! - 5000);
      expect(errorMs).toBeLessThan(2);
      expect(errorMs).toBeLessThanOrEqual(clock.uncertaintyMs!);
    }
  });

  test("is found again when a clock jumps", () => {
    const clock = new ClockOffset();
    probe(clock, 0, 100, 1, 1);
    probe(clock, 1000, 100, 1, 1);
    probe(clock, 2000, -300, 1, 1);
    expect(clock.offsetMs).toBeCloseTo(-300, 6);
    expect(clock.toServerMs(50)).toBeCloseTo(-250, 6);
  });

  test("is unknown before the first probe, after a reset, and unmoved by a probe that contradicts itself", () => {
    const clock = new ClockOffset();
    expect([clock.offsetMs, clock.uncertaintyMs, clock.toServerMs(1)]).toEqual([null, null, null]);
    probe(clock, 0, 7, 1, 3);
    clock.add({ clientSendMs: 10, serverReceiveMs: 0, serverSendMs: 100, clientReceiveMs: 10 });
    clock.add({ clientSendMs: Number.NaN, serverReceiveMs: 0, serverSendMs: 0, clientReceiveMs: 0 });
    expect(clock.offsetMs).toBeCloseTo(6, 6);
    clock.reset();
    expect(clock.offsetMs).toBeNull();
  });
});
