/**
 * A limb to draw, in host-frame millimetres: origin at the wrist, +y to the fingers, +x to the thumb. Joints are those of the
 * simulator's hand; fingers are spread by a few degrees so that they read as fingers.
 */
import type { Point } from "../../src/skin/index.js";

interface Finger {
  readonly base: Point;
  /** Direction in degrees from +y towards +x. */
  readonly deg: number;
  /** To the end of the finger. */
  readonly length: number;
  readonly halfBase: number;
  readonly halfTip: number;
}

const FINGERS: readonly [Finger, Finger, Finger, Finger] = [
  { base: [-36, 66], deg: -13, length: 69, halfBase: 9.2, halfTip: 7 },
  { base: [-18, 77], deg: -5, length: 87, halfBase: 9.8, halfTip: 7.8 },
  { base: [1, 82], deg: 1, length: 92, halfBase: 10, halfTip: 8.2 },
  { base: [21, 79], deg: 7, length: 85, halfBase: 10, halfTip: 8 },
];
const THUMB: Finger = { base: [45, 42], deg: 38, length: 56, halfBase: 12.5, halfTip: 9.2 };
const ALL = [...FINGERS, THUMB];
const WEB = 0.2;
const ELBOW_MM = -274;

const ULNAR: readonly Point[] = [
  [-38.5, ELBOW_MM], [-38, -249], [-37, -190], [-34, -120], [-30, -60], [-28, -20], [-30, 2], [-38, 22], [-43, 42], [-45.5, 58],
];
const RADIAL: readonly Point[] = [[36, 10], [29, -14], [30, -60], [36, -120], [41, -190], [43, -249], [43.5, ELBOW_MM]];

/** The closed outline, from the elbow's ulnar side around the fingers and back. */
export const OUTLINE: readonly Point[] = [
  ...ULNAR,
  ...FINGERS.flatMap((finger, i) => {
    const next = FINGERS[i + 1];
    return [...around(finger, i === 0 ? 0.2 : 0.3), ...(next ? [web(finger, next)] : [])];
  }),
  [34, 72], [37, 62],
  ...around(THUMB, 0.3),
  [57, 34], [48, 22],
  ...RADIAL,
];

/** Lines on the skin of the palm's side. */
export const PALM_LINES: readonly (readonly Point[])[] = [
  ...FINGERS.flatMap((finger) => [0.25, 0.52, 0.76].map((share) => crease(finger, share, 0.68))),
  crease(THUMB, 0.38, 0.6),
  [[-42, 56], [-24, 58], [-6, 64], [6, 76]],
  [[34, 62], [16, 60], [-8, 50], [-30, 36]],
  [[33, 60], [14, 52], [4, 30], [6, 6]],
  [[-27, -1], [-8, -4], [12, -4], [30, -2]],
];

/** Lines on the back: wrinkles over the joints, and the wrist. */
export const BACK_LINES: readonly (readonly Point[])[] = [
  ...FINGERS.flatMap((finger) => [0.49, 0.52, 0.55, 0.755].map((share) => crease(finger, share, 0.5))),
  crease(THUMB, 0.4, 0.5),
  [[-26, -2], [-8, -6], [12, -6], [28, -3]],
];

/** Fingernails as closed outlines on the back. */
export const NAILS: readonly (readonly Point[])[] = ALL.map((finger) => {
  const half = finger.halfTip * 0.62;
  const end = 1 - 2.5 / finger.length;
  const start = end - 12 / finger.length;
  const middle = (start + end) / 2;
  return [
    along(finger, start, -half * 0.8), along(finger, middle, -half), along(finger, end - 0.015, -half * 0.75), along(finger, end, 0),
    along(finger, end - 0.015, half * 0.75), along(finger, middle, half), along(finger, start, half * 0.8), along(finger, start - 0.015, 0),
  ];
});

/** An SVG path through points (Catmull-Rom), placed by `place`. */
export function smoothPath(points: readonly Point[], place: (point: Point) => Point, closed: boolean): string {
  const placed = points.map(place);
  const count = placed.length;
  const at = (i: number): Point => placed[closed ? (i + count) % count : Math.min(Math.max(i, 0), count - 1)] ?? [0, 0];
  const text = ([x, y]: Point): string => `${round(x)} ${round(y)}`;
  let path = `M${text(at(0))}`;
  for (let i = 0; i < count - (closed ? 0 : 1); i += 1) {
    const [before, from, to, after] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
    path += `C${text(handle(before, from, to, 1))} ${text(handle(from, to, after, -1))} ${text(to)}`;
  }
  return closed ? `${path}Z` : path;
}

const round = (value: number): number => Math.round(value * 100) / 100;

function handle(before: Point, at: Point, after: Point, sign: number): Point {
  return [at[0] + (sign * (after[0] - before[0])) / 6, at[1] + (sign * (after[1] - before[1])) / 6];
}

function along({ base, deg, length }: Finger, share: number, sideways: number): Point {
  const [sin, cos] = [Math.sin((deg * Math.PI) / 180), Math.cos((deg * Math.PI) / 180)];
  return [base[0] + sin * length * share + cos * sideways, base[1] + cos * length * share - sin * sideways];
}

function halfWidth(finger: Finger, share: number): number {
  return finger.halfBase + (finger.halfTip - finger.halfBase) * share;
}

function around(finger: Finger, from: number): Point[] {
  // Two straight sides, and half a circle around the last point from which the end is as far as the sides are.
  const middle = 1 - finger.halfTip / finger.length;
  const side = (share: number, sign: number): Point => along(finger, share, sign * halfWidth(finger, share));
  const tip = [-90, -54, -18, 18, 54, 90].map((deg) => {
    const turn = (deg * Math.PI) / 180;
    return along(finger, middle + (finger.halfTip * Math.cos(turn)) / finger.length, finger.halfTip * Math.sin(turn));
  });
  const sides = [from, 0.55, middle - 0.05];
  return [...sides.map((share) => side(share, -1)), ...tip, ...sides.reverse().map((share) => side(share, 1))];
}

function web(left: Finger, right: Finger): Point {
  const [a, b] = [along(left, WEB, left.halfBase), along(right, WEB, -right.halfBase)];
  return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2 - 1];
}

function crease(finger: Finger, share: number, width: number): Point[] {
  const half = halfWidth(finger, share) * width;
  return [along(finger, share, -half), along(finger, share - 0.012, 0), along(finger, share, half)];
}
