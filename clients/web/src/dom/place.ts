// Where a touch on skin is on the screen.

import type { Handedness, Surface, TouchEvent } from "../events.js";

/** A point of the viewport, in CSS pixels. */
export interface ScreenPoint {
  readonly x: number;
  readonly y: number;
}

/** Gives the place of a touch on the screen; null for one that is not on it. */
export type PlaceMap = (event: TouchEvent) => ScreenPoint | null;

/** A rectangle of skin in millimetres of the host's frame. */
export interface SkinArea {
  readonly surface?: Surface;
  readonly hostHand?: Handedness;
  readonly leftMm: number;
  readonly rightMm: number;
  readonly bottomMm: number;
  readonly topMm: number;
}

/** The palm below the fingers. */
export const PALM_AREA: SkinArea = { surface: "palm", leftMm: -40, rightMm: 40, bottomMm: 5, topMm: 85 };

/**
 * Lay a rectangle of skin over an element's box, fingers up, as the wearer sees the limb: a left palm has its thumb on the left.
 * A touch outside of the rectangle is not on the screen, except while it is captured.
 */
export function placeOn(element: Element, area: SkinArea = PALM_AREA): PlaceMap {
  return (event) => {
    if (area.surface !== undefined && event.surface !== area.surface) return null;
    if (area.hostHand !== undefined && event.hostHand !== area.hostHand) return null;
    const box = element.getBoundingClientRect();
    const isPalmSide = event.surface === "palm" || event.surface === "inner_forearm";
    const share = (event.xMm - area.leftMm) / (area.rightMm - area.leftMm);
    const isThumbLeft = (event.hostHand === "left") === isPalmSide;
    const x = box.left + (isThumbLeft ? 1 - share : share) * box.width;
    const y = box.top + ((area.topMm - event.yMm) / (area.topMm - area.bottomMm)) * box.height;
    return { x, y };
  };
}

/** Full turn. */
const TURN = 2 * Math.PI;

/** `azimuthAngle` of a finger: where its body lies, seen from the tip; 0 to the right of the screen, clockwise. */
export function azimuthOf(event: TouchEvent, map: PlaceMap): number {
  const tip = map(event);
  const aheadMm = { xMm: event.xMm + Math.sin(event.yawRad), yMm: event.yMm + Math.cos(event.yawRad) };
  const ahead = map({ ...event, ...aheadMm });
  if (!tip || !ahead) return 0;
  return (Math.atan2(tip.y - ahead.y, tip.x - ahead.x) + TURN) % TURN;
}
