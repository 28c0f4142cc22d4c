import { describe, expect, test } from "vitest";
import { handsMessage, project, readXRHands } from "../../src/headset/index.js";

const CAMERA = { fxPx: 500, fyPx: 400, cxPx: 320, cyPx: 240 };
const SPACE = {} as XRSpace;

/** A tracked hand whose 25 joints lie in a row, 10 mm apart along x, half a metre before the camera. */
function hand(handedness: XRHandedness, { joints = 25, behind = false } = {}): XRInputSource {
  const spaces = Array.from({ length: joints }, (_, i) => [String(i), { position: { x: 0.01 * i, y: 0.1, z: behind ? 0.5 : -0.5 } }] as const);
  return { handedness, hand: new Map(spaces) } as unknown as XRInputSource;
}

const frame = { getJointPose: (space: unknown) => ({ transform: space }) } as unknown as XRFrame;
const read = (...sources: XRInputSource[]) => readXRHands(frame, sources, SPACE, CAMERA);

describe("a headset's hands", () => {
  test("are given along the camera's axes and where they are in its picture", () => {
    const [pushed] = read(hand("left"));
    expect(pushed!.handedness).toBe("left");
    expect(pushed!.jointsMm.slice(0, 6)).toEqual([0, -100, 500, 10, -100, 500].map((value) => expect.closeTo(value, 6) as number));
    expect(pushed!.jointsPx.slice(0, 4)).toEqual([320, 160, 330, 160].map((value) => expect.closeTo(value, 6) as number));
    expect([pushed!.jointsMm.length, pushed!.jointsPx.length]).toEqual([75, 50]);
  });

  test("that are not wholly tracked, behind the camera, a second one of a side or no hand are left out", () => {
    expect(read(hand("left", { joints: 24 }), hand("right", { behind: true }), hand("none"), { handedness: "left" } as XRInputSource)).toEqual([]);
    expect(read(hand("right"), hand("right")).map(({ handedness }) => handedness)).toEqual(["right"]);
  });

  test("make a message of the frame's time, also when none is seen", () => {
    expect(handsMessage([], 7n)).toEqual({ timestampNs: 7n, hands: [] });
    const message = handsMessage(read(hand("right")), 7n);
    expect(message.hands).toMatchObject([{ handedness: 2 }]);
  });
});

test("a point behind the camera has no pixel", () => {
  expect(project([0, 0, 5], CAMERA)).toBeNull();
  expect(project([100, 0, 1000], CAMERA)).toEqual([370, 240]);
});
