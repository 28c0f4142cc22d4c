import type { TouchEvent } from "../../src/events.js";

/** A hovering right index finger over the middle of the left palm; `fields` replace what is different. */
export function touchEvent(fields: Partial<TouchEvent> = {}): TouchEvent {
  const hand = fields.hand ?? "right";
  return {
    type: "hover_move",
    pointerId: 1,
    contactId: 1,
    timestampNs: 0n,
    downTimeNs: null,
    finger: "index",
    hand,
    hostHand: hand === "right" ? "left" : "right",
    surface: "palm",
    touchProbability: 0.9,
    forceN: 0,
    forceSigmaN: null,
    xMm: 0,
    yMm: 50,
    dxMm: 0,
    dyMm: 0,
    velocityXMmS: 0,
    velocityYMmS: 0,
    pitchRad: Math.PI / 4,
    yawRad: 0,
    imageX: 0.5,
    imageY: 0.5,
    clickCount: 0,
    reason: null,
    coalesced: [],
    latencyMs: 10,
    late: false,
    local: false,
    ...fields,
  };
}
