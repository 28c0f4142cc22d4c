/** A surface of a tracked limb as an object of three.js. */
import { Object3D, Vector3 } from "three";
import type { Handedness, Surface, TouchEvent } from "../events.js";
import { readingAxes, toView, type Reading, type ReadingAxes } from "../skin/reading.js";
import { isInnerSide } from "../surfaces.js";
import { anchorOfHost, type HandSource, type JointFrame } from "../webxr/anchor.js";
import { turnedSkinMatrix, type Limb, type LimbOptions } from "../webxr/limb.js";

export interface SkinSurfaceOptions extends LimbOptions {
  /** The wearer's hand whose limb it is. */
  readonly host: Handedness;
  readonly surface: Surface;
  /** How the wearer holds the limb; left out, the usual way of the surface. */
  readonly reading?: Reading;
}

/**
 * The skin of one surface: what is added to it sticks to the wearer.
 *
 * Its own axes are millimetres as the wearer sees them: +x to the right, +y up, +z out of the skin, origin on the skin over the wrist.
 * Add it to the object whose space is the session's reference space (the scene, as long as that does not move). It is invisible while
 * its hand is not tracked.
 */
export class SkinSurface extends Object3D {
  readonly host: Handedness;
  readonly surface: Surface;
  readonly axes: ReadingAxes;
  readonly #options: LimbOptions;
  #limb: Limb | null = null;

  constructor({ host, surface, reading, ...options }: SkinSurfaceOptions) {
    super();
    this.host = host;
    this.surface = surface;
    this.axes = readingAxes(surface, host, reading);
    this.#options = options;
    this.matrixAutoUpdate = false;
    this.visible = false;
  }

  /** The limb in the reference space; null while it is not tracked. */
  get limb(): Limb | null {
    return this.#limb;
  }

  /** Follow the hand; call it in every frame of the session, before rendering. True while the hand is tracked. */
  track(frame: JointFrame, space: XRSpace, sources: Iterable<HandSource>): boolean {
    this.place(anchorOfHost(frame, space, sources, this.host, this.#options));
    return this.#limb !== null;
  }

  /** Lie on this limb, or on none. */
  place(limb: Limb | null): void {
    this.#limb = limb;
    this.visible = limb !== null;
    if (!limb) return;
    this.matrix.fromArray(turnedSkinMatrix(limb, this.surface, this.axes.right, this.axes.up));
    this.matrixWorldNeedsUpdate = true;
  }

  /** Where an event, or any place of the host frame, is in this object's millimetres. */
  localPlace({ xMm, yMm }: { readonly xMm: number; readonly yMm: number }, heightMm = 0, target = new Vector3()): Vector3 {
    return target.set(...toView(this.axes, [xMm, yMm]), heightMm);
  }

  /** True for an event on this side of this limb: a finger may slide on beyond the wrist. */
  carries(event: TouchEvent): boolean {
    return event.hostHand === this.host && isInnerSide(event.surface) === isInnerSide(this.surface);
  }
}
