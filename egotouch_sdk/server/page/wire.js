// Messages of `egotouch.v1.json` as plain objects: the schema's own field names, enum names without their prefix, and times in
// milliseconds (`…_ms`) in place of the decimal nanoseconds (`…_ns`). The only module that knows how a message is written; what it
// lets through has the types that views rely on.

const ENUM_PREFIX = /^(EVENT_TYPE|HANDEDNESS|FINGER|SURFACE|CANCEL_REASON|GATE_REASON)_/;
const EVENT_NUMBERS = [
  "pointer_id", "contact_id", "touch_probability", "force_n", "x_mm", "y_mm", "dx_mm", "dy_mm", "velocity_x_mm_s", "velocity_y_mm_s",
  "pitch_rad", "yaw_rad", "image_x", "image_y", "click_count",
];
const FINGERS = new Set(["THUMB", "INDEX", "MIDDLE", "RING", "PINKY"]);

/**
 * A server's message as `{kind, offset, body}`; `kind` is null for one that this page does not know. Throws for what is no such
 * message at all.
 */
export function readMessage(text) {
  const raw = JSON.parse(text);
  const kind = Object.keys(READERS).find((known) => raw[known] !== undefined) ?? null;
  return { kind, offset: counter(raw.offset), body: kind && READERS[kind](raw[kind]) };
}

/** Client time in milliseconds as the decimal nanoseconds that a 64-bit field is written with. */
export const nanoseconds = (ms) => Math.round(ms * 1e6).toString();

function number(value = 0) {
  if (!Number.isFinite(value)) throw new TypeError(`${value} is no number`);
  return value;
}

function string(value = "") {
  if (typeof value !== "string") throw new TypeError(`${value} is no text`);
  return value;
}

/** An unsigned 64-bit number, which stays the text that it is written as. */
function counter(value = "0") {
  if (!/^\d{1,20}$/.test(value)) throw new TypeError(`${value} is no counter`);
  return `${value}`;
}

const name = (value) => string(value ?? "UNSPECIFIED").replace(ENUM_PREFIX, "");
const milliseconds = (ns) => number(Number(ns ?? 0)) / 1e6;

const READERS = {
  welcome: (raw) => ({
    epoch: counter(raw.epoch),
    token: string(raw.token),
    heartbeat_ms: number(raw.heartbeat_ms),
    features: (raw.features ?? []).map(string),
    settings: { force_enter_n: number(raw.settings?.force_enter_n) },
  }),
  warning: (raw) => ({ code: string(raw.code), message: string(raw.message) }),
  heartbeat: (raw) => ({ active_contacts: number(raw.active_contacts) }),
  batch: (raw) => ({
    timestamp_ms: milliseconds(raw.timestamp_ns),
    sent_ms: milliseconds(raw.sent_ns),
    events: raw.events.map((event) => readEvent(event, raw.late === true)).filter((event) => FINGERS.has(event.finger)),
  }),
  clock_reply: (raw) => ({
    client_send_ms: milliseconds(raw.client_send_ns),
    server_receive_ms: milliseconds(raw.server_receive_ns),
    server_send_ms: milliseconds(raw.server_send_ns),
  }),
  status: (raw) => ({ fps: number(raw.fps), gate: name(raw.gate), source: string(raw.source) }),
  hands: (raw) => ({
    width_px: number(raw.width_px),
    height_px: number(raw.height_px),
    hands: raw.hands.map((hand) => ({ handedness: name(hand.handedness), landmarks_px: hand.landmarks_px.map(number) })),
  }),
};

/** One touch event; `late` marks one that must not act. */
function readEvent(raw, late) {
  return {
    ...Object.fromEntries(EVENT_NUMBERS.map((field) => [field, number(raw[field])])),
    type: name(raw.type),
    hand: name(raw.hand),
    finger: name(raw.finger),
    surface: name(raw.surface),
    reason: raw.reason === "CANCEL_REASON_UNSPECIFIED" ? null : name(raw.reason),
    timestamp_ms: milliseconds(raw.timestamp_ns),
    coalesced: (raw.coalesced ?? []).map((older) => readEvent(older, late)),
    late,
  };
}
