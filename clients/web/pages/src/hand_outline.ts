// The canonical limb that touches are drawn on, in host-frame millimetres: origin at the wrist, +y to the fingers, +x to the thumb.
// Joints are those of the simulator's hand; fingers are spread by a few degrees so that they read as fingers.

export const FOREARM_MM = 249;
/** What a view of one side shows, in millimetres. */
export const BOUNDS_MM = { left: -66, right: 98, top: 190, bottom: -FOREARM_MM };

// Base (MCP), direction in degrees from +y towards +x, length to the end of the finger, half widths at base and tip.
type Point = readonly [number, number];
/** Turns millimetres into pixels. */
type Place = (x: number, y: number) => Point;

interface Finger {
  readonly base: Point;
  readonly deg: number;
  readonly length: number;
  readonly halfBase: number;
  readonly halfTip: number;
}

const FINGERS: readonly Finger[] = [
  { base: [-36, 66], deg: -13, length: 69, halfBase: 9.2, halfTip: 7 },
  { base: [-18, 77], deg: -5, length: 87, halfBase: 9.8, halfTip: 7.8 },
  { base: [1, 82], deg: 1, length: 92, halfBase: 10, halfTip: 8.2 },
  { base: [21, 79], deg: 7, length: 85, halfBase: 10, halfTip: 8 },
];
const THUMB: Finger = { base: [45, 42], deg: 38, length: 56, halfBase: 12.5, halfTip: 9.2 };
// Where the creases of a finger lie, in parts of its length (the palm's side), and how deep its web is.
const JOINTS = [0.25, 0.52, 0.76];
const WEB = 0.2;

const ULNAR_MM: readonly Point[] = [[-38.5, -FOREARM_MM - 25], [-38, -FOREARM_MM], [-37, -190], [-34, -120], [-30, -60], [-28, -20], [-30, 2], [-38, 22], [-43, 42], [-45.5, 58]];
const RADIAL_MM: readonly Point[] = [[36, 10], [29, -14], [30, -60], [36, -120], [41, -190], [43, -FOREARM_MM], [43.5, -FOREARM_MM - 25]];

function along({ base, deg, length }: Finger, share: number, sideways: number): Point {
  const [sin, cos] = [Math.sin((deg * Math.PI) / 180), Math.cos((deg * Math.PI) / 180)];
  return [base[0] + sin * length * share + cos * sideways, base[1] + cos * length * share - sin * sideways];
}

/** Two sides that run straight into half a circle around the last point from which the end is as far as the sides are. */
function aroundFinger(finger: Finger, from: number): Point[] {
  const { halfBase, halfTip, length } = finger;
  const centre = 1 - halfTip / length;
  const side = (share: number, sign: number) => along(finger, share, sign * (halfBase + ((halfTip - halfBase) * share) / centre));
  const tip = [-90, -54, -18, 18, 54, 90].map((deg) => {
    const turn = (deg * Math.PI) / 180;
    return along(finger, centre + (halfTip * Math.cos(turn)) / length, halfTip * Math.sin(turn));
  });
  const up = [from, 0.5, centre - 0.08].map((share) => side(share, -1));
  const down = [centre - 0.08, 0.5, from].map((share) => side(share, 1));
  return [...up, ...tip, ...down];
}

function web(left: Finger, right: Finger): Point {
  const [a, b]: [Point, Point] = [along(left, WEB, left.halfBase), along(right, WEB, -right.halfBase)];
  return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2 - 1];
}

/** The closed outline as points in millimetres, from the elbow's ulnar side around the fingers and back. */
export const OUTLINE_MM: readonly Point[] = [
  ...ULNAR_MM,
  ...FINGERS.flatMap((finger, i) => [...aroundFinger(finger, i === 0 ? 0.2 : 0.3), ...(i < 3 ? [web(finger, FINGERS[i + 1]!)] : [])]),
  [34, 72], [37, 62],
  ...aroundFinger(THUMB, 0.3),
  [57, 34], [48, 22],
  ...RADIAL_MM,
];

/** Lines on the skin of the palm's side: finger creases and the three lines of the palm. */
export const PALM_LINES_MM: readonly (readonly Point[])[] = [
  ...FINGERS.flatMap((finger) => JOINTS.map((share, i) => crease(finger, share, i === 0 ? 0.72 : 0.66))),
  crease(THUMB, 0.38, 0.6),
  [[-42, 56], [-24, 58], [-6, 64], [6, 76]],
  [[34, 62], [16, 60], [-8, 50], [-30, 36]],
  [[33, 60], [14, 52], [4, 30], [6, 6]],
  [[-27, -1], [-8, -4], [12, -4], [30, -2]],
];

/** Lines on the back: knuckles, wrinkles over the joints. */
export const BACK_LINES_MM: readonly (readonly Point[])[] = [
  ...FINGERS.flatMap((finger) => [0.49, 0.52, 0.55, 0.755].map((share) => crease(finger, share, 0.5))),
  ...FINGERS.map((finger) => arc(finger.base, 7)),
  crease(THUMB, 0.4, 0.5),
  [[-26, -2], [-8, -6], [12, -6], [28, -3]],
];

/** Fingernails as closed outlines on the back. */
export const NAILS_MM: readonly (readonly Point[])[] = [...FINGERS, THUMB].map((finger) => {
  const half = finger.halfTip * 0.62;
  const end = 1 - 2.5 / finger.length;
  const start = end - 12 / finger.length;
  return [
    along(finger, start, -half * 0.8), along(finger, (start + end) / 2, -half), along(finger, end - 0.015, -half * 0.75),
    along(finger, end, 0),
    along(finger, end - 0.015, half * 0.75), along(finger, (start + end) / 2, half), along(finger, start, half * 0.8),
    along(finger, start - 0.015, 0),
  ];
});

function crease(finger: Finger, share: number, width: number): Point[] {
  const half = (finger.halfBase + (finger.halfTip - finger.halfBase) * share) * width;
  return [along(finger, share, -half), along(finger, share - 0.012, 0), along(finger, share, half)];
}

function arc([x, y]: Point, radius: number): Point[] {
  return [-60, -20, 20, 60].map((deg): Point => [x + radius * Math.sin((deg * Math.PI) / 180), y - 4 + radius * Math.cos((deg * Math.PI) / 180)]);
}

/** A smooth path through points (Catmull-Rom) as an SVG path, drawn with `place`, which turns millimetres into the picture's units. */
export function smoothPathData(points: readonly Point[], place: Place, closed: boolean): string {
  const at = (i: number) => place(...points[closed ? (i + points.length) % points.length : Math.min(Math.max(i, 0), points.length - 1)]!);
  const text = (...places: Point[]) => places.map(([x, y]) => `${x.toFixed(2)} ${y.toFixed(2)}`).join(" ");
  let path = `M${text(at(0))}`;
  for (let i = 0; i < points.length - (closed ? 0 : 1); i += 1) {
    const [p0, p1, p2, p3]: [Point, Point, Point, Point] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
    const control = (a: Point, b: Point, c: Point, sign: number): Point => [
      b[0] + (sign * (c[0] - a[0])) / 6, b[1] + (sign * (c[1] - a[1])) / 6,
    ];
    path += `C${text(control(p0, p1, p2, 1), control(p1, p2, p3, -1), p2)}`;
  }
  return closed ? `${path}Z` : path;
}

/** The same for a canvas. */
export function smoothPath(points: readonly Point[], place: Place, closed: boolean): Path2D {
  return new Path2D(smoothPathData(points, place, closed));
}
