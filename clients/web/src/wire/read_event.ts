// Touch events out of their messages; whatever makes no sense is refused before an app sees any of it.

import { EgoTouchError } from "../errors.js";
import { isHover, type CancelReason, type EventType, type TouchEvent } from "../events.js";
import type { TouchEvent as Wire } from "../gen/egotouch/v1/egotouch_pb.js";
import { CANCEL_REASONS, EVENT_TYPES, FINGERS, HANDS, SURFACES } from "./enums.js";

/** What a batch says about each of its events. */
export interface Arrival {
  readonly late: boolean;
  /** Milliseconds from capture to arrival, of an event captured at `timestampNs`; null while the clock is unknown. */
  latencyMs(timestampNs: bigint): number | null;
}

/** pi and pi/2 grow by this much at most when they are rounded to 32 bits. */
const FLOAT32_SLACK_RAD = 1e-6;
const MAY_HAVE_REASON: ReadonlySet<EventType> = new Set(["cancel", "drag_end", "force_exit"]);

/** The events in the messages, without those of a type that this version does not know; throws for a malformed one. */
export function readEvents(messages: readonly Wire[], arrival: Arrival): TouchEvent[] {
  const events: TouchEvent[] = [];
  for (const message of messages) {
    const type = EVENT_TYPES.name(message.type);
    if (type !== undefined) events.push(readEvent(message, type, arrival));
    else if (message.type === 0) throw malformed("an event has no type");
  }
  return events;
}

function readEvent(message: Wire, type: EventType, arrival: Arrival): TouchEvent {
  const finger = FINGERS.name(message.finger);
  const hand = HANDS.name(message.hand);
  const surface = SURFACES.name(message.surface);
  if (!finger || !hand || !surface) throw malformed(`a ${type} has finger ${message.finger}, hand ${message.hand}, surface ${message.surface}`);
  const reason = readReason(message.reason);
  if (type === "cancel" && reason === null) throw malformed("a cancel has no reason");
  if (reason !== null && !MAY_HAVE_REASON.has(type)) throw malformed(`a ${type} has the reason ${reason}`);
  if ((message.downTimeNs === undefined) !== isHover(type)) throw malformed(`a ${type} ${isHover(type) ? "has a" : "has no"} down time`);
  if (message.clickCount > 0 !== (type === "click" || type === "double_click")) throw malformed(`a ${type} has click count ${message.clickCount}`);
  return {
    type,
    pointerId: message.pointerId,
    contactId: message.contactId,
    timestampNs: message.timestampNs,
    downTimeNs: message.downTimeNs ?? null,
    finger,
    hand,
    hostHand: hand === "left" ? "right" : "left",
    surface,
    touchProbability: within(message.touchProbability, 0, 1, "touch_probability"),
    forceN: within(message.forceN, 0, Number.MAX_VALUE, "force_n"),
    forceSigmaN: message.forceSigmaN === undefined ? null : finite(message.forceSigmaN, "force_sigma_n"),
    xMm: finite(message.xMm, "x_mm"),
    yMm: finite(message.yMm, "y_mm"),
    dxMm: finite(message.dxMm, "dx_mm"),
    dyMm: finite(message.dyMm, "dy_mm"),
    velocityXMmS: finite(message.velocityXMmS, "velocity_x_mm_s"),
    velocityYMmS: finite(message.velocityYMmS, "velocity_y_mm_s"),
    pitchRad: angle(message.pitchRad, 0, Math.PI / 2, "pitch_rad"),
    yawRad: angle(message.yawRad, -Math.PI, Math.PI, "yaw_rad"),
    imageX: finite(message.imageX, "image_x"),
    imageY: finite(message.imageY, "image_y"),
    clickCount: message.clickCount,
    reason,
    coalesced: message.coalesced.length ? readEvents(message.coalesced, arrival) : NONE,
    latencyMs: arrival.latencyMs(message.timestampNs),
    late: arrival.late,
    local: false,
  };
}

const NONE: readonly TouchEvent[] = [];

/** A cancel with a reason of a newer server is a cancel all the same. */
function readReason(number: number): CancelReason | null {
  return number === 0 ? null : (CANCEL_REASONS.name(number) ?? "tracking_lost");
}

function angle(value: number, least: number, most: number, field: string): number {
  const near = Math.min(Math.max(value, least), most);
  return within(Math.abs(near - value) < FLOAT32_SLACK_RAD ? near : value, least, most, field);
}

function within(value: number, least: number, most: number, field: string): number {
  if (!(value >= least && value <= most)) throw malformed(`${field} is ${value}`);
  return value;
}

function finite(value: number, field: string): number {
  if (!Number.isFinite(value)) throw malformed(`${field} is ${value}`);
  return value;
}

const malformed = (what: string) => new EgoTouchError("protocol", `malformed message: ${what}`);
