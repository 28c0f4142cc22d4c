// A headset's own hands, as the server wants them: joints in camera pixels and in millimetres along the camera's axes.

import type { MessageInitShape } from "@bufbuild/protobuf";
import type { Handedness } from "../events.js";
import type { ClientHandsSchema } from "../gen/egotouch/v1/egotouch_pb.js";
import { HANDS } from "../wire/enums.js";

/** One hand: MediaPipe's 21 joints or WebXR's 25, in the order of their specification. */
export interface PushedHand {
  readonly handedness: Handedness;
  /** x, y of each joint in pixels of the frame, one after the other. */
  readonly jointsPx: readonly number[];
  /** x (right), y (down), z (away from the camera) of each joint in millimetres. */
  readonly jointsMm: readonly number[];
}

/** A pinhole camera: focal lengths and principal point in pixels of the frame that is sent. */
export interface Intrinsics {
  readonly fxPx: number;
  readonly fyPx: number;
  readonly cxPx: number;
  readonly cyPx: number;
}

/** What this needs of an `XRFrame`; spelled out, so that apps without WebXR's types can use this module. */
export interface HandJoints {
  getJointPose?(joint: object, baseSpace: object): { readonly transform: { readonly position: { readonly x: number; readonly y: number; readonly z: number } } } | undefined;
}

/** What this needs of an `XRInputSource`. */
export interface TrackedHand {
  readonly handedness: Handedness | "none";
  readonly hand?: { values(): Iterable<object> } | null | undefined;
}

const WEBXR_JOINTS = 25;
const MM_PER_M = 1000;
/** A joint this near the camera's plane has no place in its picture. */
const NEAREST_MM = 10;

/** The tracked hands of this frame as the camera at `cameraSpace` (WebXR's axes) sees them; without those that are not wholly in front of it. */
export function readXRHands(frame: HandJoints, sources: Iterable<TrackedHand>, cameraSpace: object, camera: Intrinsics): PushedHand[] {
  const hands: PushedHand[] = [];
  for (const { hand, handedness } of sources) {
    if (!hand || handedness === "none" || hands.some((other) => other.handedness === handedness)) continue;
    const jointsMm: number[] = [];
    for (const space of hand.values()) {
      const position = frame.getJointPose?.(space, cameraSpace)?.transform.position;
      if (position) jointsMm.push(position.x * MM_PER_M, -position.y * MM_PER_M, -position.z * MM_PER_M);
    }
    const jointsPx = project(jointsMm, camera);
    if (jointsMm.length === 3 * WEBXR_JOINTS && jointsPx) hands.push({ handedness, jointsPx, jointsMm });
  }
  return hands;
}

/** Pixels of points in millimetres along the camera's axes; null when one of them lies behind the camera. */
export function project(pointsMm: readonly number[], { fxPx, fyPx, cxPx, cyPx }: Intrinsics): number[] | null {
  const pixels: number[] = [];
  for (let i = 0; i < pointsMm.length; i += 3) {
    const [x, y, z] = [pointsMm[i]!, pointsMm[i + 1]!, pointsMm[i + 2]!];
    if (z < NEAREST_MM) return null;
    pixels.push(cxPx + (fxPx * x) / z, cyPx + (fyPx * y) / z);
  }
  return pixels;
}

/** The hands that a frame of the same time shows, as a message; none is said too. */
export function handsMessage(hands: readonly PushedHand[], timestampNs: bigint): MessageInitShape<typeof ClientHandsSchema> {
  return {
    timestampNs,
    hands: hands.map(({ handedness, jointsPx, jointsMm }) => ({
      handedness: HANDS.number(handedness), landmarksPx: [...jointsPx], worldMm: [...jointsMm],
    })),
  };
}
