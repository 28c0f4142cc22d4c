import type { EventType, GateReason, TouchEvent } from "../events.js";

/** Something went wrong: a listener threw, or the server sent what makes no sense. */
export interface ErrorEvent {
  readonly error: unknown;
  /** The name of the listener that threw; null when none did. */
  readonly listener: string | null;
  /** What it was told. */
  readonly event: TouchEvent | null;
}

/** What the camera sees of the wearer's hands, about once a second. */
export interface TrackingState {
  readonly gate: GateReason;
  readonly handsInView: number;
}

/** The methods of a listener, all of them optional; only what `onLongClick` returns counts. */
export interface TouchListener {
  /** A finger has met the skin. */
  onTouchDown?(event: TouchEvent): void;
  /** The finger has left the skin. */
  onTouchUp?(event: TouchEvent): void;
  /** The finger is still on the skin; one call for each camera frame. */
  onTouchMove?(event: TouchEvent): void;
  /** The touch has ended without a lift, for `event.reason`: undo what it began and act on nothing. */
  onTouchCancel?(event: TouchEvent): void;
  /** The finger has moved out of the touch slop. */
  onDragStart?(event: TouchEvent): void;
  /** The dragging finger has moved by `dxMm`, `dyMm` since its `down`. */
  onDrag?(event: TouchEvent): void;
  /** The drag is over; `event.reason` is set when it was cancelled. */
  onDragEnd?(event: TouchEvent): void;
  /** The finger has tapped. */
  onClick?(event: TouchEvent): void;
  /** The finger has tapped twice at one place. */
  onDoubleClick?(event: TouchEvent): void;
  /** The finger rests on the skin; return true to keep this contact from becoming a click for any listener. */
  onLongClick?(event: TouchEvent): boolean | void;
  /** A force press begins (`force_enter`), changes (`force_change`) or ends (`force_exit`). */
  onForce?(event: TouchEvent): void;
  /** The finger has left the skin in motion, with `velocityXMmS`, `velocityYMmS`. */
  onFling?(event: TouchEvent): void;
  /** A fingertip has come over the skin. */
  onHoverEnter?(event: TouchEvent): void;
  /** The fingertip is still over the skin. */
  onHoverMove?(event: TouchEvent): void;
  /** The fingertip is gone. */
  onHoverExit?(event: TouchEvent): void;
  /** An event that came too late to act on, for logs; only where `subscribe` asks for `lateEdges`. */
  onLate?(event: TouchEvent): void;
}

/** The method that gets each type of event. */
export const METHODS: Readonly<Record<EventType, keyof TouchListener>> = {
  down: "onTouchDown",
  up: "onTouchUp",
  move: "onTouchMove",
  cancel: "onTouchCancel",
  drag_start: "onDragStart",
  drag: "onDrag",
  drag_end: "onDragEnd",
  click: "onClick",
  double_click: "onDoubleClick",
  long_click: "onLongClick",
  force_enter: "onForce",
  force_change: "onForce",
  force_exit: "onForce",
  fling: "onFling",
  hover_enter: "onHoverEnter",
  hover_move: "onHoverMove",
  hover_exit: "onHoverExit",
};

/** All names of `TouchListener`. */
export const LISTENER_NAMES: readonly (keyof TouchListener)[] = [...new Set(Object.values(METHODS)), "onLate"];

