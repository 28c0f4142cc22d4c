/** Views on skin as one listener of touch events. */
import type { Finger, Handedness, Surface, TouchEvent } from "../events.js";
import { LayoutError } from "./errors.js";
import { Fingers, type CallName } from "./fingers.js";
import type { SkinKeypad } from "./keypad.js";
import type { SkinLayout } from "./layout.js";
import type { SkinButton } from "./views.js";

/** `onLongClick` may return true to keep this contact from clicking. */
export type ViewListener = (event: TouchEvent, view: SkinButton) => unknown;
/** `onLongKey` may return true to keep this contact from becoming a key. */
export type KeyListener = (press: KeyPress) => unknown;

/** A key of a keypad was pressed: `event` is the up that ended it, or the long click. */
export interface KeyPress {
  readonly keypad: SkinKeypad;
  readonly key: string;
  readonly event: TouchEvent;
}

/** How one view looks; `forceN` is that of the finger pressing it, 0 otherwise. */
export interface ViewLook {
  readonly isHovered: boolean;
  readonly isPressed: boolean;
  readonly forceN: number;
}

/** A finger over or on the skin, to be drawn. */
export interface FingerLook {
  readonly pointerId: number;
  readonly finger: Finger;
  readonly host: Handedness;
  readonly surface: Surface;
  readonly xMm: number;
  readonly yMm: number;
  readonly pitchRad: number;
  readonly yawRad: number;
  readonly forceN: number;
  readonly isTouching: boolean;
}

const PLAIN: ViewLook = { isHovered: false, isPressed: false, forceN: 0 };

/**
 * Brings a layout to life: give each touch event to `handle`, in order.
 *
 * A view captures the finger that comes down on it until up or cancel. A finger that slides within a button still clicks it; one that
 * leaves it does not, nor does a cancelled touch. Listeners of a view get its events in the order hover, down, moves, up, click.
 */
export class SkinViewGroup {
  readonly layout: SkinLayout;
  readonly #fingers: Fingers;
  readonly #listeners = new Map<string, Map<CallName, Set<ViewListener>>>();

  constructor(layout: SkinLayout) {
    this.layout = layout;
    this.#fingers = new Fingers(layout.views);
  }

  /** Listen to one view, a keypad's key as `<keypad>/<key>`; gives what ends it. Throws `LayoutError` for an unknown name. */
  on(viewName: string, call: CallName, listener: ViewListener): () => void {
    if (!this.layout.views.some(({ name }) => name === viewName)) {
      throw new LayoutError(`there is no view ${viewName}; there are: ${this.layout.views.map(({ name }) => name).join(", ")}`);
    }
    const calls = this.#listeners.get(viewName) ?? new Map<CallName, Set<ViewListener>>();
    const listeners = calls.get(call) ?? new Set<ViewListener>();
    this.#listeners.set(viewName, calls.set(call, listeners.add(listener)));
    return () => void listeners.delete(listener);
  }

  /** Listen to all keys of all keypads. */
  onKey(listener: KeyListener): () => void {
    return this.#onKeys("onClick", listener);
  }

  /** Listen to keys that are held. */
  onLongKey(listener: KeyListener): () => void {
    return this.#onKeys("onLongClick", listener);
  }

  /** Take in any touch event; true when an `onLongClick` or `onLongKey` has consumed it. Throws what listeners throw, after all were called. */
  handle(event: TouchEvent): boolean {
    const errors: unknown[] = [];
    let isConsumed = false;
    for (const { view, name } of this.#fingers.step(event)) {
      for (const listener of [...(this.#listeners.get(view.name)?.get(name) ?? [])]) {
        try {
          if (listener(event, view) === true && name === "onLongClick") isConsumed = true;
        } catch (error) {
          errors.push(error);
        }
      }
    }
    if (isConsumed) this.#fingers.consume(event.pointerId);
    if (errors.length === 1) throw errors[0];
    if (errors.length > 1) throw new AggregateError(errors, "several listeners have thrown");
    return isConsumed;
  }

  /** How a view looks now. */
  look(view: SkinButton): ViewLook {
    let look = PLAIN;
    for (const { view: under, state, event } of this.#fingers.all) {
      if (under !== view) continue;
      if (state === "hovering") look = { ...look, isHovered: true };
      else if (state === "pressed") look = { ...look, isPressed: true, forceN: event.forceN };
    }
    return look;
  }

  /** All fingers over or on the skin. */
  get fingers(): readonly FingerLook[] {
    return this.#fingers.all.map(({ event }) => {
      const { pointerId, finger, hostHand: host, surface, xMm, yMm, pitchRad, yawRad, forceN, type } = event;
      const isTouching = type !== "up" && type !== "cancel" && !type.startsWith("hover");
      return { pointerId, finger, host, surface, xMm, yMm, pitchRad, yawRad, forceN, isTouching };
    });
  }

  #onKeys(call: CallName, listener: KeyListener): () => void {
    const ends = this.layout.keypads.flatMap((keypad) =>
      keypad.keys.map(({ name, key }) => this.on(name, call, (event) => listener({ keypad, key, event }))),
    );
    return () => ends.forEach((end) => end());
  }
}
