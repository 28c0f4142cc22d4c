// The drawing loop. A page that falls behind draws less often, so that events are still taken in at once.

import type { EgoTouchClient } from "../../src/index.js";

const MAX_PAUSE_MS = 250;

/** Call `draw(now)` on every animation frame, or more rarely while events wait longer than usual to be read. */
export function everyFrame(client: EgoTouchClient, draw: (now: number) => void): void {
  let pauseMs = 0;
  let drawn = 0;
  client.onBatch(({ latencyMs, sendMs, late }) => {
    if (latencyMs !== null && sendMs !== null && !late) pauseMs = Math.min((latencyMs - sendMs) / 2, MAX_PAUSE_MS);
  });
  const frame = (now: number) => {
    if (now - drawn >= pauseMs) {
      drawn = now;
      draw(now);
    }
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
}

/** A function that runs `work` at most once in `everyMs`. */
export function atMostEvery(everyMs: number, work: (now: number) => void): (now: number) => void {
  let last = -Infinity;
  return (now) => {
    if (now - last < everyMs) return;
    last = now;
    work(now);
  };
}
