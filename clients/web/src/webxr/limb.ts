/**
 * The host frame of touch events in a headset's space: pure geometry, in metres, without a browser.
 *
 * Events say where the skin is touched in millimetres of the wearer's own limb: origin at the wrist, +y to the knuckle of the middle
 * finger, +x to the thumb side. A headset that tracks that hand knows where the limb is, so no camera has to be calibrated.
 */
import type { Handedness, Surface } from "../events.js";
import { isInnerSide } from "../surfaces.js";
import { cross, dot, length, minus, plus, times, type Vec3 } from "./vectors.js";

/** The joints that carry the frame, in metres: WebXR's `wrist` and the three `…-finger-phalanx-proximal`. */
export interface Knuckles {
  readonly wrist: Vec3;
  readonly index: Vec3;
  readonly middle: Vec3;
  readonly pinky: Vec3;
}

/** A host limb: `wrist` is the origin of event millimetres, the other vectors have length 1; `palm` points out of the palm. */
export interface Limb {
  readonly host: Handedness;
  readonly wrist: Vec3;
  readonly thumb: Vec3;
  readonly fingers: Vec3;
  readonly palm: Vec3;
  /** How long one event millimetre is on this wearer. */
  readonly metresPerMm: number;
}

export interface LimbOptions {
  /**
   * Wrist to middle knuckle as the server counts it: `host.palm_mm` of its settings, 83 when that is not set. With 83 a layout grows
   * with the wearer's hand; with the wearer's own length an event millimetre is a millimetre.
   */
  readonly palmMm?: number;
}

/** A place on a limb: millimetres of the host frame, and above the skin. */
export interface HostPlace {
  readonly xMm: number;
  readonly yMm: number;
  readonly heightMm: number;
}

/** Column-major 4 x 4, as WebXR and three.js have them. */
export type Matrix = readonly number[];

/** The server's usual hand: wrist to middle knuckle between the camera tracker's landmarks (`PALM_MM` in egotouch_sdk/host_frame). */
export const USUAL_PALM_MM = 83;

// The camera tracker's wrist and knuckles lie nearer to the fingers than a headset's, by shares of the length between the headset's:
// 16 mm and 7 mm on the generic WebXR hand, whose wrist and middle knuckle are 91.7 mm apart (`WRIST_SHIFT_M`, `MCP_SHIFT_M` in
// egotouch_sdk/synthetic, our measurement).
const WRIST_SHIFT = 16 / 91.7;
const KNUCKLE_SHIFT = 7 / 91.7;

/**
 * How far the skin lies from the plane of the joints, in event millimetres: medians around the keypads on the generic WebXR hand
 * (our measurement; the ball of the thumb rises to 42 mm, the edge of the palm falls to 14 mm).
 */
export const SKIN_MM: Readonly<Record<Surface, number>> = { palm: 24, back_of_hand: 12, inner_forearm: 25, outer_forearm: 20 };

// No wearer's palm is shorter or longer; what lies outside is a tracker's mistake (our choice).
const PALM_M = { least: 0.03, most: 0.2 };
const LEAST_WIDTH_M = 0.005;

/** The limb of these joints; null when they are no hand: not finite, on one spot or in one line. */
export function limbFromKnuckles(joints: Knuckles, host: Handedness, { palmMm = USUAL_PALM_MM }: LimbOptions = {}): Limb | null {
  if (!(palmMm > 0)) throw new RangeError(`palmMm is ${palmMm}: give millimetres above 0, or leave it out`);
  const axis = minus(joints.middle, joints.wrist);
  const axisM = length(axis);
  if (!(axisM >= PALM_M.least && axisM <= PALM_M.most)) return null;
  const fingers = times(axis, 1 / axisM);
  const thumbwards = minus(joints.index, joints.pinky);
  const across = minus(thumbwards, times(fingers, dot(thumbwards, fingers)));
  const widthM = length(across);
  if (!(widthM >= LEAST_WIDTH_M && widthM <= PALM_M.most)) return null;
  const thumb = times(across, 1 / widthM);
  return {
    host,
    wrist: plus(joints.wrist, times(axis, WRIST_SHIFT)),
    thumb,
    fingers,
    palm: host === "right" ? cross(thumb, fingers) : cross(fingers, thumb),
    metresPerMm: (axisM * (1 - WRIST_SHIFT + KNUCKLE_SHIFT)) / palmMm,
  };
}

/** Unit vector out of the skin of a surface. */
export const outOfSkin = (limb: Limb, surface: Surface): Vec3 => (isInnerSide(surface) ? limb.palm : times(limb.palm, -1));

/** Where a place of the skin is, in metres; `heightMm` above the skin. */
export function toSpace(limb: Limb, surface: Surface, { xMm, yMm, heightMm = 0 }: Omit<HostPlace, "heightMm"> & Partial<HostPlace>): Vec3 {
  const up = outOfSkin(limb, surface);
  const onAxes = plus(plus(times(limb.thumb, xMm), times(limb.fingers, yMm)), times(up, heightMm + SKIN_MM[surface]));
  return plus(limb.wrist, times(onAxes, limb.metresPerMm));
}

/** The place of a surface below a point in metres: undoes `toSpace`. */
export function toHost(limb: Limb, surface: Surface, point: Vec3): HostPlace {
  const off = times(minus(point, limb.wrist), 1 / limb.metresPerMm);
  return {
    xMm: dot(off, limb.thumb),
    yMm: dot(off, limb.fingers),
    heightMm: dot(off, outOfSkin(limb, surface)) - SKIN_MM[surface],
  };
}

/**
 * Matrix from (xMm, yMm, heightMm) of a surface to metres. It mirrors on the left palm and the right back, where the thumb side
 * lies on the left; to show text there use `turnedSkinMatrix`.
 */
export function skinMatrix(limb: Limb, surface: Surface): Matrix {
  return matrixOf(limb, surface, limb.thumb, limb.fingers);
}

/** Matrix from (right, up, out of the skin) in millimetres to metres, for the two directions on the skin given as (x, y) of the host frame. */
export function turnedSkinMatrix(limb: Limb, surface: Surface, right: readonly [number, number], up: readonly [number, number]): Matrix {
  const onLimb = ([x, y]: readonly [number, number]): Vec3 => plus(times(limb.thumb, x), times(limb.fingers, y));
  return matrixOf(limb, surface, onLimb(right), onLimb(up));
}

/** Direction of the touching fingertip, DIP to TIP, of an event's angles: length 1. */
export function fingerDirection(limb: Limb, surface: Surface, pitchRad: number, yawRad: number): Vec3 {
  const level = plus(times(limb.thumb, Math.sin(yawRad)), times(limb.fingers, Math.cos(yawRad)));
  return minus(times(level, Math.cos(pitchRad)), times(outOfSkin(limb, surface), Math.sin(pitchRad)));
}

/** Cosine between a surface's normal and the way to an eye: 1 when it is looked at squarely, below 0 when it faces away. */
export function facing(limb: Limb, surface: Surface, eye: Vec3): number {
  const towards = minus(eye, limb.wrist);
  return dot(towards, outOfSkin(limb, surface)) / Math.max(length(towards), 1e-9);
}

function matrixOf(limb: Limb, surface: Surface, right: Vec3, up: Vec3): Matrix {
  const s = limb.metresPerMm;
  const out = outOfSkin(limb, surface);
  const origin = toSpace(limb, surface, { xMm: 0, yMm: 0 });
  return [...times(right, s), 0, ...times(up, s), 0, ...times(out, s), 0, ...origin, 1];
}
