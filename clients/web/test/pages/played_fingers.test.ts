import { beforeEach, describe, expect, test } from "vitest";
import { PlayedFingers } from "../../pages/src/played_fingers.js";

describe("played fingers", () => {
  let fingers: PlayedFingers;
  let now: number;

  beforeEach(() => {
    // A finger's place is the pointer's; everything is skin.
    const view = { toMm: (x: number, y: number) => [x, y] as const, isOnSkin: () => true, surfaceAt: () => "palm" as const };
    const settings = { finger: "index", forceN: 1, pitchRad: 1, yawRad: 0, hoverMm: 12, hoverOnly: false, deviceForce: true } as const;
    fingers = new PlayedFingers(view, () => settings);
    now = 0;
  });

  const touch = (id: number, down: boolean) => fingers.move({ id, x: id, y: 50, pen: null }, { down, now });
  const tap = (id: number) => {
    touch(id, true);
    touch(id, false);
    fingers.leave(id, now);
  };
  /** Play for some milliseconds; gives the fingers and their heights over the skin. */
  const play = (ms: number) => {
    const played = fingers.at((now += ms));
    fingers.noteSent(now);
    return played.map(({ finger, hoverMm }) => `${finger} ${hoverMm}`);
  };

  test("a tap of no length touches for a while, then hovers, then leaves; also when the page was busy for a second before", () => {
    tap(1);
    expect([play(1000), play(80), play(20), play(200), play(100)]).toEqual([["index 0"], ["index 0"], ["index 12"], ["index 12"], []]);
  });

  test("a second tap is the same finger's", () => {
    tap(1);
    const first = play(10);
    play(150);
    tap(2);
    expect([first, play(10), play(100)]).toEqual([["index 0"], ["index 0"], ["index 12"]]);
  });

  test("fingers that touch together are neighbours", () => {
    for (const id of [1, 2, 3]) touch(id, true);
    expect(play(10)).toEqual(["index 0", "middle 0", "thumb 0"]);
  });
});
