// The emulator's hand with its own joints and poses, moved and turned at will, as WebXR would give it to a page.
import { P_SPACE, XRSpace } from "iwer";
import { oculusHandConfig, XRHandInput } from "iwer/lib/device/XRHandInput.js";
import { GlobalSpace, XRSpaceUtils } from "iwer/lib/spaces/XRSpace.js";
import type { Handedness } from "../../src/events.js";
import type { HandSource, JointFrame } from "../../src/webxr/anchor.js";
import type { Vec3 } from "../../src/webxr/vectors.js";

export type Quaternion = readonly [number, number, number, number];
export const POSES = Object.keys(oculusHandConfig.poses);

export class EmulatedHand {
  readonly #input: XRHandInput;
  /** Joints that are not tracked at the moment. */
  readonly lost = new Set<string>();

  constructor(readonly host: Handedness, pose = "default") {
    this.#input = new XRHandInput(oculusHandConfig, host as never, new GlobalSpace());
    this.#input.poseId = pose;
    this.#input.updateHandPose();
    this.move([0, 0, 0], [0, 0, 0, 1]);
  }

  get source(): HandSource {
    return this.#input.inputSource as unknown as HandSource;
  }

  move(position: Vec3, turn: Quaternion): void {
    this.#input.position.set(...position);
    this.#input.quaternion.set(...turn);
    this.#input.updateTargetRaySpace();
  }

  get frame(): JointFrame {
    const getJointPose = (space: unknown): unknown => {
      if (this.lost.has((space as { jointName: string }).jointName)) return undefined;
      const m = XRSpaceUtils.calculateGlobalOffsetMatrix(space as XRSpace);
      return { transform: { position: { x: m[12], y: m[13], z: m[14] } } };
    };
    return { getJointPose: getJointPose as XRFrame["getJointPose"] };
  }

  /** A column of a joint's rotation: WebXR's +y points out of the back of the hand, -z to the fingertip. */
  axis(joint: XRHandJoint, axis: "x" | "y" | "z"): Vec3 {
    const from = 4 * "xyz".indexOf(axis);
    const m = this.#matrix(joint);
    return [m[from]!, m[from + 1]!, m[from + 2]!];
  }

  at(joint: XRHandJoint): Vec3 {
    const m = this.#matrix(joint);
    return [m[12]!, m[13]!, m[14]!];
  }

  #matrix(joint: XRHandJoint): ArrayLike<number> {
    const space = this.source.hand?.get(joint) as unknown as XRSpace;
    if (!(P_SPACE in space)) throw new Error(`no joint ${joint}`);
    return XRSpaceUtils.calculateGlobalOffsetMatrix(space);
  }
}
