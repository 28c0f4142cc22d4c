// What an app hears: the events of `egotouch.v1` in camelCase, with the names and units of the Python package.

/** What happened to a pointer; the values are those of Python's `EventType`. */
export type EventType =
  | "hover_enter" | "hover_move" | "hover_exit"
  | "down" | "move" | "up" | "cancel"
  | "click" | "double_click" | "long_click"
  | "drag_start" | "drag" | "drag_end"
  | "force_enter" | "force_change" | "force_exit"
  | "fling";

export type Finger = "thumb" | "index" | "middle" | "ring" | "pinky";

/** A side of the wearer, not of the picture. */
export type Handedness = "left" | "right";

/** The skin under the fingertip, on the limb of the other hand. */
export type Surface = "palm" | "back_of_hand" | "inner_forearm" | "outer_forearm";

/** Why a touch ended without a lift. */
export type CancelReason =
  | "tracking_lost" | "hand_swapped" | "source_stalled" | "source_ended" | "disconnected" | "server_stopped";

/** Why no finger can touch at the moment; `open` means that one can. */
export type GateReason = "open" | "no_hands" | "no_host" | "too_far" | "no_active_finger";

/** One event of one pointer: a fingertip from its `hover_enter` to its `hover_exit`. */
export interface TouchEvent {
  readonly type: EventType;
  /** Constant from `hover_enter` to `hover_exit`. */
  readonly pointerId: number;
  /** Counts the pointer's touches from 1; 0 before the first. */
  readonly contactId: number;
  /** Capture time of the camera frame on the server's monotonic clock, in nanoseconds. */
  readonly timestampNs: bigint;
  /** Capture time of the contact's `down`; null on hover events. */
  readonly downTimeNs: bigint | null;
  /** The touching finger and its hand. */
  readonly finger: Finger;
  readonly hand: Handedness;
  /** The hand whose limb is touched: the other one. */
  readonly hostHand: Handedness;
  readonly surface: Surface;
  /** 0..1. */
  readonly touchProbability: number;
  /** Newtons, 0..3.5 or so; 0 unless the finger is seen on the skin. */
  readonly forceN: number;
  /** Standard error of `forceN`, in newtons; null when the model gives none. */
  readonly forceSigmaN: number | null;
  /** Touch point in the host's frame, millimetres: origin at the wrist, +y to the middle MCP, +x to the thumb's side. */
  readonly xMm: number;
  readonly yMm: number;
  /** The way since the contact's `down`, millimetres; 0 while hovering. */
  readonly dxMm: number;
  readonly dyMm: number;
  /** Millimetres per second in the host's frame; 0 while hovering. */
  readonly velocityXMmS: number;
  readonly velocityYMmS: number;
  /** 0 for a finger flat on the skin, pi/2 for one perpendicular to it. */
  readonly pitchRad: number;
  /** (-pi, pi]: 0 for a finger that points along +y, positive towards +x. */
  readonly yawRad: number;
  /** Fingertip in the camera's image, 0..1 from the top left. */
  readonly imageX: number;
  readonly imageY: number;
  /** 1 on a `click`, 2 on the second `click` and its `double_click`, 0 on all others. */
  readonly clickCount: number;
  /** Set on `cancel`, and on a `drag_end` or `force_exit` that the cancel brings about. */
  readonly reason: CancelReason | null;
  /** Older events of the same kind that were merged into this one, oldest first. */
  readonly coalesced: readonly TouchEvent[];
  /** Milliseconds from capture to arrival here, by the synchronised clock; null on events that this client made itself. */
  readonly latencyMs: number | null;
  /** True for an event that came too late: it is for logs, an app must not act on it. */
  readonly late: boolean;
  /** True for an event that this client made itself because the server fell silent or went away. */
  readonly local: boolean;
}

/** All events of one camera frame; they happen together. */
export interface TouchBatch {
  readonly events: readonly TouchEvent[];
  readonly frameIndex: bigint;
  /** Capture time of the frame, server's clock, nanoseconds. */
  readonly timestampNs: bigint;
  /** Milliseconds from capture to sending; null for a local batch. */
  readonly sendMs: number | null;
  /** Milliseconds from capture to arrival here; null for a local batch. */
  readonly latencyMs: number | null;
  readonly late: boolean;
  /** True when this client made the events itself. */
  readonly local: boolean;
}

/** True for the events that may be merged for a slow consumer; all others are edges and never get lost. */
export function isStream(type: EventType): boolean {
  return type === "move" || type === "hover_move" || type === "drag" || type === "force_change";
}

/** True for the three hover events, which lie outside a contact. */
export function isHover(type: EventType): boolean {
  return type === "hover_enter" || type === "hover_move" || type === "hover_exit";
}
