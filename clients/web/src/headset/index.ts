export { sendCamera, type CameraOptions, type CameraSource } from "./camera.js";
export type { FrameCounts } from "./frame_slot.js";
export { handsMessage, project, readXRHands, type HandJoints, type Intrinsics, type PushedHand, type TrackedHand } from "./hands.js";
