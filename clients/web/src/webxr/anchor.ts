/** From a WebXR session's tracked hands to limbs. */
import type { Handedness } from "../events.js";
import { limbFromKnuckles, type Knuckles, type Limb, type LimbOptions } from "./limb.js";
import type { Vec3 } from "./vectors.js";

const JOINTS = {
  wrist: "wrist",
  index: "index-finger-phalanx-proximal",
  middle: "middle-finger-phalanx-proximal",
  pinky: "pinky-finger-phalanx-proximal",
} as const satisfies Record<keyof Knuckles, XRHandJoint>;

/** What this needs of an `XRFrame`. */
export interface JointFrame {
  getJointPose?: XRFrame["getJointPose"];
}

/** What this needs of an `XRInputSource`. */
export interface HandSource {
  readonly hand?: XRHand | null | undefined;
  readonly handedness: XRHandedness;
}

/**
 * The limb of a tracked hand in `space`, in whose millimetres touch events on that hand and its forearm are.
 *
 * Ask anew in every frame. Null while the hand is not tracked, and for an input source that is no hand of the left or right.
 */
export function anchorFromXRHand(frame: JointFrame, space: XRSpace, source: HandSource, options: LimbOptions = {}): Limb | null {
  const { hand, handedness } = source;
  if (!hand || handedness === "none" || !frame.getJointPose) return null;
  const at = (joint: XRHandJoint): Vec3 | null => {
    const jointSpace = hand.get(joint);
    const position = jointSpace && frame.getJointPose?.(jointSpace, space)?.transform.position;
    return position ? [position.x, position.y, position.z] : null;
  };
  const [wrist, index, middle, pinky] = [at(JOINTS.wrist), at(JOINTS.index), at(JOINTS.middle), at(JOINTS.pinky)];
  return wrist && index && middle && pinky && limbFromKnuckles({ wrist, index, middle, pinky }, handedness, options);
}

/** The limb of one of the wearer's hands, whichever input source it is. */
export function anchorOfHost(
  frame: JointFrame,
  space: XRSpace,
  sources: Iterable<HandSource>,
  host: Handedness,
  options: LimbOptions = {},
): Limb | null {
  for (const source of sources) {
    if (source.handedness === host && source.hand) return anchorFromXRHand(frame, space, source, options);
  }
  return null;
}
