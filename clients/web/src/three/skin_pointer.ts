/** Touches on skin as pointers of `@pmndrs/pointer-events`, so that three.js user interfaces written for it feel them. */
import { createLinesPointer, type GetCamera, type Pointer } from "@pmndrs/pointer-events";
import { Object3D, Vector3 } from "three";
import type { TouchEvent } from "../events.js";
import type { SkinSurface } from "./skin_surface.js";

/** What handlers find in `event.pointerState`. */
export interface SkinPointerState {
  /** The last touch event of this fingertip: force, angles, place on the limb. */
  touch: TouchEvent;
}

export interface SkinPointersOptions {
  /** Objects below it are touched. */
  readonly scene: Object3D;
  readonly surfaces: readonly SkinSurface[];
  readonly camera: GetCamera;
  /** A touch that is held longer does not click; 400 ms, the server's long press, when left out. */
  readonly clickThresholdMs?: number;
  /** How far above and below the skin objects are felt, in millimetres; 40 when left out. */
  readonly reachMm?: number;
}

/** Pressure 1 in newtons, as in the other adapters. */
const FULL_FORCE_N = 3.5;
const LEFT_BUTTON = 0;

/** Drives one pointer per fingertip: `handle` each touch event in order, and call `update` in every frame. */
export class SkinPointers {
  readonly #options: SkinPointersOptions;
  readonly #pointers = new Map<number, SkinPointer>();

  constructor(options: SkinPointersOptions) {
    this.#options = options;
  }

  /** Fingertips over or on the skin at the moment. */
  get size(): number {
    return this.#pointers.size;
  }

  /** Take in any touch event. What came too late does not press; whatever is cancelled gets `pointercancel` and no click. */
  handle(event: TouchEvent): void {
    let pointer = this.#pointers.get(event.pointerId);
    if (!pointer) {
      if (event.type === "hover_exit") return;
      pointer = new SkinPointer(event, this.#options);
      this.#pointers.set(event.pointerId, pointer);
    }
    pointer.handle(event);
    if (event.type === "hover_exit") this.#pointers.delete(event.pointerId);
  }

  /** Limb or objects may have moved under resting fingers. */
  update(): void {
    for (const pointer of this.#pointers.values()) pointer.update();
  }

  /** Cancel what is down and take all fingers away. */
  clear(): void {
    for (const pointer of this.#pointers.values()) pointer.remove();
    this.#pointers.clear();
  }
}

/** One fingertip, from its first event to its `hover_exit`: a short line through the skin at the place of the touch. */
export class SkinPointer {
  readonly pointer: Pointer;
  readonly #state: SkinPointerState;
  readonly #options: SkinPointersOptions;
  readonly #probe = new Object3D();
  #isDown = false;

  constructor(event: TouchEvent, options: SkinPointersOptions) {
    const { reachMm = 40, clickThresholdMs = 400, camera } = options;
    this.#options = options;
    this.#state = { touch: event };
    const linePoints = [new Vector3(0, 0, reachMm), new Vector3(0, 0, -reachMm)];
    this.pointer = createLinesPointer(camera, { current: this.#probe }, this.#state, { linePoints, clickThresholdMs }, "touch");
  }

  handle(event: TouchEvent): void {
    this.#state.touch = event;
    switch (event.type) {
      case "hover_enter":
      case "hover_move":
      case "move":
        this.#move(event);
        break;
      case "down":
        if (this.#move(event) && !event.late) {
          this.#isDown = true;
          this.pointer.down(nativeOf(event));
        }
        break;
      case "up":
        if (event.late || !this.#move(event)) this.#cancel(event);
        else if (this.#isDown) this.pointer.up(nativeOf(event));
        this.#isDown = false;
        break;
      case "cancel":
        this.#cancel(event);
        break;
      case "hover_exit":
        this.remove();
        break;
      default: // clicks, drags and forces follow from these
    }
  }

  update(): void {
    this.#move(this.#state.touch);
  }

  /** Take the finger away; what is down is cancelled. */
  remove(): void {
    this.pointer.exit(nativeOf(this.#state.touch));
    this.#isDown = false;
    this.#probe.removeFromParent();
    globalThis.pointerEventspointerMap?.delete(this.pointer.id);
  }

  #cancel(event: TouchEvent): void {
    if (this.#isDown) this.pointer.cancel(nativeOf(event));
    this.#isDown = false;
  }

  /** Go where the event is; false when its limb is not there, which also takes the finger away. */
  #move(event: TouchEvent): boolean {
    const surface = this.#options.surfaces.find((candidate) => candidate.visible && candidate.carries(event));
    if (!surface) {
      this.pointer.exit(nativeOf(event));
      this.#isDown = false;
      return false;
    }
    surface.add(this.#probe);
    surface.localPlace(event, 0, this.#probe.position);
    this.#probe.updateMatrix();
    this.pointer.move(this.#options.scene, nativeOf(event));
    return true;
  }
}

function nativeOf(event: TouchEvent): { timeStamp: number; button: number; buttons: number; pressure: number } {
  const isDown = event.forceN > 0;
  return {
    timeStamp: Number(event.timestampNs / 1000n) / 1000,
    button: LEFT_BUTTON,
    buttons: isDown ? 1 : 0,
    pressure: Math.min(event.forceN / FULL_FORCE_N, 1),
  };
}
