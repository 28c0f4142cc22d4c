import fc from "fast-check";
import { describe, expect, test } from "vitest";
import type { Handedness, Surface } from "../../src/events.js";
import { anchorFromXRHand, anchorOfHost, facing, fingerDirection, outOfSkin, skinMatrix, toHost, toSpace, type Limb } from "../../src/webxr/index.js";
import { cross, dot, length, minus, plus, times, type Vec3 } from "../../src/webxr/vectors.js";
import { EmulatedHand, POSES, type Quaternion } from "./emulated_hand.js";

const SPACE = {} as XRSpace;
const SURFACES: readonly Surface[] = ["palm", "back_of_hand", "inner_forearm", "outer_forearm"];
const hosts = fc.constantFrom<Handedness>("left", "right");
const surfaces = fc.constantFrom(...SURFACES);
const poses = fc.constantFrom(...POSES);
const coordinate = fc.double({ min: -3, max: 3, noNaN: true });
const positions = fc.tuple(coordinate, coordinate, coordinate);
const turns = fc
  .array(fc.double({ min: -1, max: 1, noNaN: true }), { minLength: 4, maxLength: 4 })
  .filter((parts) => Math.hypot(...parts) > 0.1)
  .map((parts) => parts.map((part) => part / Math.hypot(...parts)) as unknown as Quaternion);
const mm = fc.double({ min: -200, max: 200, noNaN: true });

function limbOf(hand: EmulatedHand): Limb {
  const limb = anchorFromXRHand(hand.frame, SPACE, hand.source);
  if (!limb) throw new Error("the emulated hand is no limb");
  return limb;
}

function moved(host: Handedness, pose: string, position: Vec3, turn: Quaternion): EmulatedHand {
  const hand = new EmulatedHand(host, pose);
  hand.move(position, turn);
  return hand;
}

const close = (a: Vec3, b: Vec3, within = 1e-5): void => expect(length(minus(a, b))).toBeLessThan(within);

describe("the anchor of a tracked hand", () => {
  test("has its axes at right angles, +y to the middle knuckle and +x on the thumb's side, however the hand is held", () => {
    fc.assert(
      fc.property(hosts, poses, positions, turns, (host, pose, position, turn) => {
        const hand = moved(host, pose, position, turn);
        const limb = limbOf(hand);
        for (const axis of [limb.thumb, limb.fingers, limb.palm]) expect(length(axis)).toBeCloseTo(1, 5);
        for (const [a, b] of [[limb.thumb, limb.fingers], [limb.fingers, limb.palm], [limb.palm, limb.thumb]] as const) {
          expect(dot(a, b)).toBeCloseTo(0, 5);
        }
        const knuckle = toHost(limb, "palm", hand.at("middle-finger-phalanx-proximal"));
        expect(knuckle.xMm).toBeCloseTo(0, 2);
        expect(knuckle.yMm).toBeGreaterThan(70);
        expect(toHost(limb, "palm", hand.at("thumb-phalanx-proximal")).xMm).toBeGreaterThan(10);
        expect(toHost(limb, "palm", hand.at("pinky-finger-phalanx-proximal")).xMm).toBeLessThan(-20);
      }),
    );
  });

  test("has the palm where WebXR's own orientation of the wrist says: opposite to +y, which leaves the back of the hand", () => {
    fc.assert(
      fc.property(hosts, poses, positions, turns, (host, pose, position, turn) => {
        const hand = moved(host, pose, position, turn);
        const limb = limbOf(hand);
        expect(dot(limb.palm, hand.axis("wrist", "y"))).toBeLessThan(-0.9);
        expect(dot(limb.fingers, hand.axis("wrist", "z"))).toBeLessThan(-0.9);
      }),
    );
  });

  test("takes places to metres and back, on every surface of either limb", () => {
    fc.assert(
      fc.property(hosts, surfaces, positions, turns, mm, mm, mm, (host, surface, position, turn, xMm, yMm, heightMm) => {
        const limb = limbOf(moved(host, "default", position, turn));
        const back = toHost(limb, surface, toSpace(limb, surface, { xMm, yMm, heightMm }));
        expect(back.xMm).toBeCloseTo(xMm, 3);
        expect(back.yMm).toBeCloseTo(yMm, 3);
        expect(back.heightMm).toBeCloseTo(heightMm, 3);
      }),
    );
  });

  test("has a matrix that says the same as toSpace", () => {
    fc.assert(
      fc.property(hosts, surfaces, positions, turns, mm, mm, mm, (host, surface, position, turn, x, y, z) => {
        const limb = limbOf(moved(host, "default", position, turn));
        const m = skinMatrix(limb, surface);
        const row = (i: number): number => m[i]! * x + m[4 + i]! * y + m[8 + i]! * z + m[12 + i]!;
        close([row(0), row(1), row(2)], toSpace(limb, surface, { xMm: x, yMm: y, heightMm: z }));
      }),
    );
  });

  test("moves and turns with the hand as one rigid body", () => {
    fc.assert(
      fc.property(hosts, surfaces, positions, turns, mm, mm, (host, surface, position, turn, xMm, yMm) => {
        const still = toSpace(limbOf(new EmulatedHand(host)), surface, { xMm, yMm });
        const there = toSpace(limbOf(moved(host, "default", position, turn)), surface, { xMm, yMm });
        close(there, plus(rotated(still, turn), position));
      }),
    );
  });

  test("moves by little when the hand does", () => {
    fc.assert(
      fc.property(hosts, surfaces, positions, turns, (host, surface, position, turn) => {
        const [x, y, z, w] = turn;
        const nearby = [x + 1e-4, y, z - 1e-4, w] as const;
        const size = Math.hypot(...nearby);
        const place = { xMm: 20, yMm: -150 };
        const before = toSpace(limbOf(moved(host, "default", position, turn)), surface, place);
        const after = toSpace(limbOf(moved(host, "default", position, nearby.map((v) => v / size) as unknown as Quaternion)), surface, place);
        expect(length(minus(after, before))).toBeLessThan(1e-3);
      }),
    );
  });

  test("mirrors the left hand into the right one", () => {
    const [left, right] = [limbOf(new EmulatedHand("left")), limbOf(new EmulatedHand("right"))];
    const mirrored = ([x, y, z]: Vec3): Vec3 => [-x, y, z];
    for (const surface of SURFACES) {
      close(mirrored(toSpace(left, surface, { xMm: 30, yMm: 12 })), toSpace(right, surface, { xMm: 30, yMm: 12 }));
    }
    expect(left.metresPerMm).toBeCloseTo(right.metresPerMm, 6);
  });

  test("puts both sides of the limb back to back, the forearm behind the wrist", () => {
    const limb = limbOf(new EmulatedHand("left"));
    const [palm, back] = [toSpace(limb, "palm", { xMm: 0, yMm: 40 }), toSpace(limb, "back_of_hand", { xMm: 0, yMm: 40 })];
    expect(dot(minus(palm, back), limb.palm)).toBeGreaterThan(0.02);
    close(outOfSkin(limb, "palm"), times(outOfSkin(limb, "back_of_hand"), -1));
    expect(dot(minus(toSpace(limb, "inner_forearm", { xMm: 0, yMm: -100 }), limb.wrist), limb.fingers)).toBeLessThan(-0.09);
  });

  test("grows with the hand, unless the server knows the wearer's own size", () => {
    const hand = new EmulatedHand("right");
    const usual = limbOf(hand);
    // The emulator's hand is 95.7 mm from wrist to middle knuckle, 86.3 mm between the landmarks that a camera's tracker would find.
    expect(usual.metresPerMm * 83).toBeCloseTo(0.0863, 3);
    const own = anchorFromXRHand(hand.frame, SPACE, hand.source, { palmMm: 86.3 });
    expect((own?.metresPerMm ?? 0) * 1000).toBeCloseTo(1, 2);
    expect(() => anchorFromXRHand(hand.frame, SPACE, hand.source, { palmMm: 0 })).toThrow(RangeError);
  });

  test("is null while a joint is not tracked, for controllers and for hands that are none", () => {
    const hand = new EmulatedHand("left");
    hand.lost.add("pinky-finger-phalanx-proximal");
    expect(anchorFromXRHand(hand.frame, SPACE, hand.source)).toBeNull();
    hand.lost.clear();
    expect(anchorFromXRHand(hand.frame, SPACE, { handedness: "left" })).toBeNull();
    expect(anchorFromXRHand(hand.frame, SPACE, { hand: hand.source.hand, handedness: "none" })).toBeNull();
    expect(anchorFromXRHand({}, SPACE, hand.source)).toBeNull();
    hand.move([Number.NaN, 0, 0], [0, 0, 0, 1]);
    expect(anchorFromXRHand(hand.frame, SPACE, hand.source)).toBeNull();
  });

  test("is found by the host's side among all input sources", () => {
    const [left, right] = [new EmulatedHand("left"), new EmulatedHand("right")];
    right.move([1, 0, 0], [0, 0, 0, 1]);
    const sources = [{ handedness: "left" } as const, left.source, right.source];
    expect(anchorOfHost(right.frame, SPACE, sources, "right")).toEqual(limbOf(right));
    expect(anchorOfHost(left.frame, SPACE, sources, "left")).toEqual(limbOf(left));
    expect(anchorOfHost(left.frame, SPACE, [left.source], "right")).toBeNull();
  });
});

describe("a finger's direction", () => {
  test("has the pitch and yaw of the event it comes from", () => {
    const angle = fc.double({ min: 0, max: Math.PI / 2 - 0.01, noNaN: true });
    const yaw = fc.double({ min: -3.14, max: 3.14, noNaN: true });
    fc.assert(
      fc.property(hosts, surfaces, turns, angle, yaw, (host, surface, turn, pitchRad, yawRad) => {
        const limb = limbOf(moved(host, "default", [0, 0, 0], turn));
        const direction = fingerDirection(limb, surface, pitchRad, yawRad);
        expect(length(direction)).toBeCloseTo(1, 6);
        expect(Math.asin(-dot(direction, outOfSkin(limb, surface)))).toBeCloseTo(pitchRad, 4);
        const seen = Math.atan2(dot(direction, limb.thumb), dot(direction, limb.fingers));
        expect(Math.cos(seen - yawRad)).toBeCloseTo(1, 6);
      }),
    );
  });
});

test("a surface faces an eye before it and not one behind it", () => {
  const limb = limbOf(new EmulatedHand("left"));
  const eye = plus(limb.wrist, times(limb.palm, 0.4));
  expect(facing(limb, "palm", eye)).toBeCloseTo(1, 6);
  expect(facing(limb, "back_of_hand", eye)).toBeCloseTo(-1, 6);
});

function rotated(v: Vec3, [x, y, z, w]: Quaternion): Vec3 {
  const axis: Vec3 = [x, y, z];
  const t = times(cross(axis, v), 2);
  return plus(plus(v, times(t, w)), cross(axis, t));
}
