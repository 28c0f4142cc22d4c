import { beforeEach, describe, expect, test } from "vitest";
import { PlayedFinger } from "../../examples/skin_keypad/played_finger.js";
import { skinKeypad } from "../../src/skin/index.js";

const PALM = skinKeypad({ name: "pad", surface: "palm", host: "left", rows: [["1"]], xMm: 0, yMm: 40, pitchMm: 15 });

describe("the mouse as a finger", () => {
  let finger: PlayedFinger;
  beforeEach(() => {
    finger = new PlayedFinger();
    finger.move([3, 40], PALM, null);
  });
  /** What is sent at a time: "touch", "hover", "gone", or "" for nothing. */
  const at = (now: number, changed = true): string => {
    const body = finger.message(now, changed);
    if (body?.case !== "simulated") return "";
    const [pointer] = body.value.pointers ?? [];
    if (!pointer) return "gone";
    expect((pointer.forceN ?? 0) > 0).toBe(pointer.hoverMm === 0);
    return pointer.hoverMm === 0 ? "touch" : "hover";
  };

  test("hovers, touches, hovers again, and is gone a moment after it left", () => {
    expect(at(0)).toBe("hover");
    finger.press(10);
    expect([at(16), at(32)]).toEqual(["touch", "touch"]);
    finger.lift();
    expect(at(200)).toBe("hover");
    finger.leave(300);
    expect([at(400), at(701), at(720)]).toEqual(["hover", "gone", ""]);
  });

  test("touches for a while even when the tap was over before anything could be sent", () => {
    finger.press(10);
    finger.lift();
    finger.leave(12);
    expect([at(2000), at(2100), at(2115), at(2500), at(2520)]).toEqual(["touch", "touch", "hover", "hover", "gone"]);
  });

  test("presses harder the longer it is held, a pen as hard as it says", () => {
    const force = (now: number): number => {
      const body = finger.message(now, true);
      return body?.case === "simulated" ? (body.value.pointers?.[0]?.forceN ?? 0) : 0;
    };
    finger.press(0);
    expect(force(0)).toBeCloseTo(0.7);
    expect(force(800)).toBeGreaterThan(force(400));
    expect(force(60_000)).toBeCloseTo(3.2);
    finger.move([3, 40], PALM, 0.5);
    expect(force(60_010)).toBeCloseTo(1.75);
  });

  test("is sent again only now and then while nothing changes, so that the server does not forget it", () => {
    expect([at(0), at(50, false), at(100, false), at(150, false)]).toEqual(["hover", "", "hover", ""]);
  });

  test("is gone at once when the hand is taken away, a touch with it", () => {
    finger.press(0);
    expect(at(0)).toBe("touch");
    finger.vanish();
    expect([at(10), at(20)]).toEqual(["gone", ""]);
  });

  test("goes on over the wrist onto the forearm", () => {
    finger.move([3, -20], PALM, null);
    const body = finger.message(0, true);
    expect(body).toMatchObject({ case: "simulated", value: { pointers: [{ hand: 2, finger: 2, surface: 3, xMm: 3, yMm: -20 }] } });
  });
});
