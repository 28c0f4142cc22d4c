/** Which finger has to do with which view: the table of the Python package (`egotouch_sdk/skin/table.py`), driven by touch events. */
import type { EventType, TouchEvent } from "../events.js";
import { isHit, isHoverKept, isKept, type SkinButton } from "./views.js";

/** `strayed` has captured a view and is outside it. */
export type FingerState = "away" | "hovering" | "pressed" | "strayed";

type Input =
  | "hover on" | "hover onto" | "hover off" | "gone"
  | "press" | "press nothing" | "inside" | "outside" | "lift inside" | "lift outside"
  | "cancel" | "long click" | "derived";

/** A call to a view's listeners. */
export type CallName =
  | "onHoverEnter" | "onHoverMove" | "onHoverExit"
  | "onTouchDown" | "onTouchMove" | "onTouchUp" | "onTouchCancel"
  | "onClick" | "onLongClick" | "onDragStart" | "onDrag" | "onDragEnd" | "onForce";

type Row = readonly [FingerState, ...(CallName | "derived")[]];

const TABLE: Readonly<Record<FingerState, Readonly<Partial<Record<Input, Row>>>>> = {
  away: {
    "hover onto": ["hovering", "onHoverEnter"],
    "hover off": ["away"],
    gone: ["away"],
    press: ["pressed", "onTouchDown"],
    "press nothing": ["away"],
    outside: ["away"],
    "lift outside": ["away"],
    cancel: ["away"],
    "long click": ["away"],
    derived: ["away"],
  },
  hovering: {
    "hover on": ["hovering", "onHoverMove"],
    "hover onto": ["hovering", "onHoverExit", "onHoverEnter"],
    "hover off": ["away", "onHoverExit"],
    gone: ["away", "onHoverExit"],
    press: ["pressed", "onHoverExit", "onTouchDown"],
    "press nothing": ["away", "onHoverExit"],
  },
  pressed: {
    inside: ["pressed", "onTouchMove"],
    outside: ["strayed", "onTouchMove"],
    "lift inside": ["away", "onTouchUp", "onClick"],
    "lift outside": ["away", "onTouchUp"],
    cancel: ["away", "onTouchCancel"],
    "long click": ["pressed", "onLongClick"],
    derived: ["pressed", "derived"],
  },
  strayed: {
    inside: ["pressed", "onTouchMove"],
    outside: ["strayed", "onTouchMove"],
    "lift inside": ["away", "onTouchUp", "onClick"],
    "lift outside": ["away", "onTouchUp"],
    cancel: ["away", "onTouchCancel"],
    "long click": ["strayed"],
    derived: ["strayed", "derived"],
  },
};

const DERIVED: Readonly<Partial<Record<EventType, CallName>>> = {
  drag_start: "onDragStart",
  drag: "onDrag",
  drag_end: "onDragEnd",
  force_enter: "onForce",
  force_change: "onForce",
  force_exit: "onForce",
};
/** Views make their own clicks from down and up; a fling belongs to no view, since the finger has left. */
const IGNORED: ReadonlySet<EventType> = new Set(["click", "double_click", "fling"]);

/** One finger: its last event, and the view it hovers over or has captured (null when it is away). */
export interface TrackedFinger {
  readonly event: TouchEvent;
  readonly state: FingerState;
  readonly view: SkinButton | null;
  readonly isConsumed: boolean;
}

export interface ViewCall {
  readonly view: SkinButton;
  readonly name: CallName;
}

/** What one event means for the views: the calls come in the order in which they must be made. */
export class Fingers {
  readonly #topDown: readonly SkinButton[];
  readonly #fingers = new Map<number, TrackedFinger>();

  constructor(views: readonly SkinButton[]) {
    this.#topDown = [...views].reverse();
  }

  /** All fingers over or on the skin, in order of appearance. */
  get all(): readonly TrackedFinger[] {
    return [...this.#fingers.values()];
  }

  /**
   * Take in one event.
   *
   * A late event never acts: a late down captures nothing, a late up does not click. One that cannot follow those before, as after a
   * gap, lets go of what its finger held without a click.
   */
  step(event: TouchEvent): readonly ViewCall[] {
    if (IGNORED.has(event.type)) return [];
    const before = this.#fingers.get(event.pointerId) ?? { event, state: "away", view: null, isConsumed: false };
    const [input, target] = this.#read(before, event);
    const row = TABLE[before.state][input];
    if (!row) {
      this.#put({ event, state: "away", view: null, isConsumed: false });
      return before.view ? [{ view: before.view, name: before.state === "hovering" ? "onHoverExit" : "onTouchCancel" }] : [];
    }
    const [state, ...names] = row;
    this.#put({ event, state, view: state === "away" ? null : target, isConsumed: before.isConsumed && input !== "press" });
    return names.flatMap((name): ViewCall[] => {
      const view = name === "onHoverExit" ? before.view : target;
      if (!view || (name === "onClick" && before.isConsumed)) return [];
      const called = name === "derived" ? DERIVED[event.type] : name;
      return called ? [{ view, name: called }] : [];
    });
  }

  /** Keep the finger's contact from becoming a click. */
  consume(pointerId: number): void {
    const finger = this.#fingers.get(pointerId);
    if (finger) this.#fingers.set(pointerId, { ...finger, isConsumed: true });
  }

  #put(finger: TrackedFinger): void {
    if (finger.event.type === "hover_exit") this.#fingers.delete(finger.event.pointerId);
    else this.#fingers.set(finger.event.pointerId, finger);
  }

  #read(finger: TrackedFinger, event: TouchEvent): [Input, SkinButton | null] {
    const { view } = finger;
    switch (event.type) {
      case "hover_enter":
      case "hover_move": {
        const under = this.#under(event, view);
        return under ? [under === view ? "hover on" : "hover onto", under] : ["hover off", null];
      }
      case "hover_exit":
        return ["gone", view];
      case "down": {
        const under = event.late ? null : this.#under(event, view);
        return under && !this.#isCaptured(under, event.pointerId) ? ["press", under] : ["press nothing", null];
      }
      case "cancel":
        return ["cancel", view];
      case "long_click":
        return [event.late ? "derived" : "long click", view];
      case "move":
        return [view && isKept(view, event) ? "inside" : "outside", view];
      case "up":
        return [view && !event.late && isKept(view, event) ? "lift inside" : "lift outside", view];
      default:
        return ["derived", view];
    }
  }

  #under(event: TouchEvent, current: SkinButton | null): SkinButton | null {
    if (current && !isHit(current, event) && isHoverKept(current, event)) return current;
    return this.#topDown.find((view) => isHit(view, event)) ?? null;
  }

  #isCaptured(view: SkinButton, otherThan: number): boolean {
    return [...this.#fingers].some(
      ([id, finger]) => id !== otherThan && finger.view === view && (finger.state === "pressed" || finger.state === "strayed"),
    );
  }
}
