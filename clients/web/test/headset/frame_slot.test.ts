import { expect, test } from "vitest";
import { FrameSlot } from "../../src/headset/frame_slot.js";

const MS = 1_000_000n;

test("one frame is coded at a time; those that come meanwhile are left out, the newest afterwards is taken", () => {
  const slot = new FrameSlot(30);
  expect(slot.offer(1000, 0)).toBe(1000n * MS);
  expect([slot.offer(1040, 0), slot.offer(1080, 0)]).toEqual([null, null]);
  slot.done(true);
  expect(slot.offer(1120, 0)).toBe(1120n * MS);
  slot.done(false);
  expect(slot.counts).toEqual({ sent: 1, skipped: 3 });
});

test("nothing is coded while pictures wait in the socket", () => {
  const slot = new FrameSlot(30);
  expect(slot.offer(1000, 300_000)).toBeNull();
  expect(slot.offer(1001, 100_000)).not.toBeNull();
});

test("a rate below the camera's is kept; a camera that is a little fast loses nothing", () => {
  const taken = (fps: number, stepMs: number) => {
    const slot = new FrameSlot(fps);
    let count = 0;
    for (let i = 0; i < 300; i += 1) {
      if (slot.offer(1000 + i * stepMs, 0) === null) continue;
      count += 1;
      slot.done(true);
    }
    return count;
  };
  expect([taken(30, 33.3), taken(30, 32), taken(15, 33.3), taken(10, 33.3)]).toEqual([300, 300, 150, 100]);
});

test("times rise, also where the browser stamps two frames alike", () => {
  const slot = new FrameSlot(1e6);
  const times = [1000, 1000, 1000].map((at) => {
    const time = slot.offer(at, 0);
    slot.done(true);
    return time;
  });
  const kept = times.filter((time) => time !== null);
  expect(kept).toEqual([...new Set(kept)].sort());
});
