/** What can be put on skin: plain descriptions without behaviour or state. */
import type { Handedness, Surface, TouchEvent } from "../events.js";
import { isInnerSide } from "../surfaces.js";
import { contains, outlineDistance } from "./polygon.js";
import type { Point } from "./reading.js";

/** A pressing finger may leave a view this far before it counts as outside; a hovering one half of it (`SLOP_MM` of the Python package). */
export const SLOP_MM = 5;
const HOVER_SHARE = 0.5;

/** Skin inside a polygon of the host frame; `host` keeps it to one hand, null to both. */
export interface Region {
  readonly surface: Surface;
  readonly host: Handedness | null;
  readonly pointsMm: readonly Point[];
}

/** A region to be pressed; `name` is unique in a layout, `label` is what is written on it. */
export interface SkinButton {
  readonly name: string;
  readonly label: string;
  readonly region: Region;
  readonly slopMm: number;
}

/** True when a touch lies inside: right limb, right surface, right place. */
export function isHit({ region }: SkinButton, event: TouchEvent): boolean {
  return event.surface === region.surface && isBeside(region, event) && containsEvent(region, event, 0);
}

/** True when a finger that was inside still counts as inside: within the slop and on this side of the limb, beyond the wrist too. */
export function isKept({ region, slopMm }: SkinButton, event: TouchEvent): boolean {
  return isBeside(region, event) && containsEvent(region, event, slopMm);
}

/** The same for a hovering finger, whose highlight must not flicker. */
export function isHoverKept({ region, slopMm }: SkinButton, event: TouchEvent): boolean {
  return isBeside(region, event) && containsEvent(region, event, slopMm * HOVER_SHARE);
}

function isBeside(region: Region, event: TouchEvent): boolean {
  return isInnerSide(event.surface) === isInnerSide(region.surface) && (region.host === null || region.host === event.hostHand);
}

function containsEvent({ pointsMm }: Region, { xMm, yMm }: TouchEvent, slopMm: number): boolean {
  return contains(pointsMm, [xMm, yMm]) || outlineDistance(pointsMm, [xMm, yMm]) <= slopMm;
}
