/** Plane geometry of polygons in millimetres. */
import type { Point } from "./reading.js";

/** True inside the polygon, by the even-odd rule; points exactly on the outline may fall on either side. */
export function contains(points: readonly Point[], [x, y]: Point): boolean {
  let inside = false;
  for (const [[ax, ay], [bx, by]] of edges(points)) {
    if (ay > y !== by > y && x < ax + ((y - ay) * (bx - ax)) / (by - ay)) inside = !inside;
  }
  return inside;
}

/** Distance to the nearest point of the outline, whichever side the point is on. */
export function outlineDistance(points: readonly Point[], place: Point): number {
  return Math.min(...edges(points).map((edge) => edgeDistance(edge, place)));
}

/** Area in mm², positive when the corners run from +x to +y. */
export function signedArea(points: readonly Point[]): number {
  return edges(points).reduce((sum, [[ax, ay], [bx, by]]) => sum + ax * by - bx * ay, 0) / 2;
}

/** Four corners around a centre; the width runs along x, the height along y. */
export function rectangle(x: number, y: number, width: number, height: number): Point[] {
  const [w, h] = [width / 2, height / 2];
  return [[x - w, y - h], [x + w, y - h], [x + w, y + h], [x - w, y + h]];
}

/** A circle as a polygon of 32 corners on it. */
export function circle(x: number, y: number, radius: number): Point[] {
  return Array.from({ length: 32 }, (_, k): Point => onCircle(x, y, radius, (2 * Math.PI * k) / 32));
}

/** A rectangle whose corners are quarter circles. */
export function rounded(x: number, y: number, width: number, height: number, corner: number): Point[] {
  return rectangle(x, y, width - 2 * corner, height - 2 * corner).flatMap(([cx, cy], quarter) =>
    Array.from({ length: 9 }, (_, step) => onCircle(cx, cy, corner, Math.PI + (quarter * Math.PI) / 2 + (step * Math.PI) / 16)),
  );
}

function edges(points: readonly Point[]): (readonly [Point, Point])[] {
  return points.map((point, i) => [point, points[(i + 1) % points.length] ?? point]);
}

function edgeDistance([[ax, ay], [bx, by]]: readonly [Point, Point], [x, y]: Point): number {
  const [dx, dy] = [bx - ax, by - ay];
  const squared = dx * dx + dy * dy;
  const share = squared === 0 ? 0 : Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / squared, 0), 1);
  return Math.hypot(x - ax - share * dx, y - ay - share * dy);
}

function onCircle(x: number, y: number, radius: number, angle: number): Point {
  return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
}
