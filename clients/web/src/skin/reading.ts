/** Which way text reads on a limb, as its wearer sees it. */
import type { Handedness, Surface } from "../events.js";
import { isInnerSide } from "../surfaces.js";

/** `across`: fingers up or away, text runs across the limb. `along`: arm across the body, text runs along it, like a watch. */
export type Reading = "across" | "along";

/** A place or a direction on the skin: (x, y) of the host frame. */
export type Point = readonly [number, number];

/** The way each surface is usually held (our choice, as in the Python package). */
export const USUAL_READING: Readonly<Record<Surface, Reading>> = {
  palm: "across",
  back_of_hand: "across",
  inner_forearm: "along",
  outer_forearm: "along",
};

/** The wearer's right and up as unit vectors of the host frame. */
export interface ReadingAxes {
  readonly right: Point;
  readonly up: Point;
}

/**
 * Where right and up are on a limb for its wearer.
 *
 * Fingers up, a wearer sees the thumb of the left palm and of the right back on the left, that of the other two on the right. With the
 * arm across the body the left hand's fingers point right and the right hand's left.
 */
export function readingAxes(surface: Surface, host: Handedness, reading: Reading = USUAL_READING[surface]): ReadingAxes {
  const thumb = (host === "right") === isInnerSide(surface) ? 1 : -1;
  if (reading === "across") return { right: [thumb, 0], up: [0, 1] };
  return host === "left" ? { right: [0, 1], up: [-thumb, 0] } : { right: [0, -1], up: [thumb, 0] };
}

/** Host frame to the wearer's view: millimetres to the right and up. */
export const toView = ({ right, up }: ReadingAxes, [x, y]: Point): Point => [x * right[0] + y * right[1], x * up[0] + y * up[1]];

/** The wearer's view to the host frame: undoes `toView`. */
export const toHostFrame = ({ right, up }: ReadingAxes, [r, u]: Point): Point => [r * right[0] + u * up[0], r * right[1] + u * up[1]];
