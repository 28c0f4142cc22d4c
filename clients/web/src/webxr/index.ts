export { anchorFromXRHand, anchorOfHost, type HandSource, type JointFrame } from "./anchor.js";
export {
  facing,
  fingerDirection,
  limbFromKnuckles,
  outOfSkin,
  SKIN_MM,
  skinMatrix,
  toHost,
  toSpace,
  turnedSkinMatrix,
  USUAL_PALM_MM,
  type HostPlace,
  type Knuckles,
  type Limb,
  type LimbOptions,
  type Matrix,
} from "./limb.js";
export type { Vec3 } from "./vectors.js";
