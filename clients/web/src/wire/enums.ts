// Enum values of this package and their numbers in the schema. Number 0 stands for "not given" and is nobody's.

import type { CancelReason, EventType, Finger, GateReason, Handedness, Surface } from "../events.js";

export class EnumTable<Name extends string> {
  readonly names: readonly Name[];

  /** `names` in the order of their numbers, from 1. */
  constructor(...names: Name[]) {
    this.names = names;
  }

  /** The name of a number; undefined for 0 and for what a newer schema may have added. */
  name(number: number): Name | undefined {
    return number > 0 ? this.names[number - 1] : undefined;
  }

  number(name: Name): number {
    return this.names.indexOf(name) + 1;
  }
}

export const EVENT_TYPES = new EnumTable<EventType>(
  "hover_enter", "hover_move", "hover_exit", "down", "move", "up", "cancel", "click", "double_click", "long_click", "drag_start", "drag",
  "drag_end", "force_enter", "force_change", "force_exit", "fling",
);
export const FINGERS = new EnumTable<Finger>("thumb", "index", "middle", "ring", "pinky");
export const HANDS = new EnumTable<Handedness>("left", "right");
export const SURFACES = new EnumTable<Surface>("palm", "back_of_hand", "inner_forearm", "outer_forearm");
export const CANCEL_REASONS = new EnumTable<CancelReason>(
  "tracking_lost", "hand_swapped", "source_stalled", "source_ended", "disconnected", "server_stopped",
);
export const GATE_REASONS = new EnumTable<GateReason>("open", "no_hands", "no_host", "too_far", "no_active_finger");
