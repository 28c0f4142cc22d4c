// Messages of `egotouch.v1.json` as plain objects: the schema's own field names, enum names without their prefix, and times in
// milliseconds (`…_ms`) in place of the decimal nanoseconds (`…_ns`). The only module that knows how a message is written.

const ENUM_PREFIX = /^(EVENT_TYPE|HANDEDNESS|FINGER|SURFACE|CANCEL_REASON|GATE_REASON)_/;

const name = (value) => `${value ?? "UNSPECIFIED"}`.replace(ENUM_PREFIX, "");
const milliseconds = (ns) => Number(ns) / 1e6;

/** A server's message as `{kind, offset, body}`; `kind` is null for one that this page does not know. Throws for what is no JSON. */
export function readMessage(text) {
  const raw = JSON.parse(text);
  const kind = Object.keys(READERS).find((known) => raw[known] !== undefined) ?? null;
  return { kind, offset: raw.offset, body: kind && READERS[kind](raw[kind]) };
}

/** Client time in milliseconds as the decimal nanoseconds that a 64-bit field is written with. */
export const nanoseconds = (ms) => Math.round(ms * 1e6).toString();

const asIs = (raw) => raw;

const READERS = {
  welcome: asIs,
  warning: asIs,
  heartbeat: asIs,
  batch: (raw) => ({
    timestamp_ms: milliseconds(raw.timestamp_ns),
    sent_ms: milliseconds(raw.sent_ns),
    late: raw.late,
    events: raw.events.map((event) => readEvent(event, raw.late)),
  }),
  clock_reply: (raw) => ({
    client_send_ms: milliseconds(raw.client_send_ns),
    server_receive_ms: milliseconds(raw.server_receive_ns),
    server_send_ms: milliseconds(raw.server_send_ns),
  }),
  status: (raw) => ({ ...raw, gate: name(raw.gate) }),
  hands: (raw) => ({ ...raw, hands: raw.hands.map((hand) => ({ ...hand, handedness: name(hand.handedness) })) }),
};

/** One touch event; `late` marks one that must not act. */
function readEvent(raw, late) {
  return {
    ...raw,
    type: name(raw.type),
    hand: name(raw.hand),
    finger: name(raw.finger),
    surface: name(raw.surface),
    reason: raw.reason === "CANCEL_REASON_UNSPECIFIED" ? null : name(raw.reason),
    timestamp_ms: milliseconds(raw.timestamp_ns),
    coalesced: raw.coalesced.map((older) => readEvent(older, late)),
    late,
  };
}
