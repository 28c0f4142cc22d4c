// The drawing loop. A page that falls behind draws less often, so that events are still taken in at once.

const MAX_PAUSE_MS = 250;

/** Call `draw(now)` on every animation frame, or more rarely while messages of `connection` wait longer than usual to be read. */
export function everyFrame(connection, draw) {
  let pauseMs = 0;
  let drawn = 0;
  connection.addEventListener("timing", ({ detail: { ageMs, sendMs } }) => (pauseMs = Math.min((ageMs - sendMs) / 2, MAX_PAUSE_MS)));
  const frame = (now) => {
    if (now - drawn >= pauseMs) {
      drawn = now;
      draw(now);
    }
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
}

/** A function that runs `work` at most once in `everyMs`. */
export function atMostEvery(everyMs, work) {
  let last = -Infinity;
  return (now) => {
    if (now - last < everyMs) return;
    last = now;
    work(now);
  };
}
