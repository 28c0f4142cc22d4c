import fc from "fast-check";
import { Object3D, Scene, Vector3 } from "three";
import { describe, expect, test } from "vitest";
import type { Handedness, Surface } from "../../src/events.js";
import { SkinSurface } from "../../src/three/index.js";
import { toSpace } from "../../src/webxr/index.js";
import { touchEvent } from "../support/events.js";
import { EmulatedHand } from "../webxr/emulated_hand.js";

const SPACE = {} as XRSpace;
const SURFACES: readonly Surface[] = ["palm", "back_of_hand", "inner_forearm", "outer_forearm"];

function onHand(host: Handedness, surface: Surface, hand = new EmulatedHand(host)): SkinSurface {
  const skin = new SkinSurface({ host, surface });
  new Scene().add(skin);
  expect(skin.track(hand.frame, SPACE, [hand.source])).toBe(true);
  skin.updateWorldMatrix(true, true);
  return skin;
}

describe("a surface of the skin", () => {
  test("puts an event where it is on the tracked limb", () => {
    const mm = fc.double({ min: -150, max: 150, noNaN: true });
    fc.assert(
      fc.property(fc.constantFrom<Handedness>("left", "right"), fc.constantFrom(...SURFACES), mm, mm, (host, surface, xMm, yMm) => {
        const skin = onHand(host, surface);
        const world = skin.localToWorld(skin.localPlace({ xMm, yMm }, 7));
        const [x, y, z] = toSpace(skin.limb!, surface, { xMm, yMm, heightMm: 7 });
        expect(world.distanceTo(new Vector3(x, y, z))).toBeLessThan(1e-6);
      }),
    );
  });

  test("is never mirrored, so that text on it can be read", () => {
    for (const host of ["left", "right"] as const) {
      for (const surface of SURFACES) expect(onHand(host, surface).matrixWorld.determinant()).toBeGreaterThan(0);
    }
  });

  test("carries what is added to it along with the hand", () => {
    const hand = new EmulatedHand("left");
    const skin = onHand("left", "palm", hand);
    const key = new Object3D();
    skin.localPlace({ xMm: 11, yMm: 68.5 }, 0, key.position);
    skin.add(key);
    const before = key.getWorldPosition(new Vector3());
    hand.move([0.1, 0.2, -0.3], [0, 0, 0, 1]);
    skin.track(hand.frame, SPACE, [hand.source]);
    expect(key.getWorldPosition(new Vector3()).sub(before).toArray()).toEqual([0.1, 0.2, -0.3].map((v) => expect.closeTo(v, 5) as number));
  });

  test("is invisible while its hand is not tracked, and back afterwards", () => {
    const hand = new EmulatedHand("left");
    const skin = onHand("left", "palm", hand);
    expect(skin.visible).toBe(true);
    hand.lost.add("wrist");
    expect(skin.track(hand.frame, SPACE, [hand.source])).toBe(false);
    expect([skin.visible, skin.limb]).toEqual([false, null]);
    hand.lost.clear();
    skin.track(hand.frame, SPACE, [new EmulatedHand("right").source, hand.source]);
    expect(skin.visible).toBe(true);
  });

  test("carries the events of its own side of its own limb", () => {
    const skin = onHand("left", "palm");
    expect(skin.carries(touchEvent({ surface: "palm" }))).toBe(true);
    expect(skin.carries(touchEvent({ surface: "inner_forearm" }))).toBe(true);
    expect(skin.carries(touchEvent({ surface: "back_of_hand" }))).toBe(false);
    expect(skin.carries(touchEvent({ hand: "left" }))).toBe(false);
  });
});
