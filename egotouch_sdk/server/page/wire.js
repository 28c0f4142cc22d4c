// Messages of `egotouch.v1.json` (proto3's canonical JSON) as plain objects with every field filled in. Times become
// milliseconds (numbers); enum names lose their prefix. The only module that knows how a message is written.

const DROPPED_PREFIX = /^(EVENT_TYPE|HANDEDNESS|FINGER|SURFACE|CANCEL_REASON|GATE_REASON)_/;

const name = (value) => (value ?? "UNSPECIFIED").toString().replace(DROPPED_PREFIX, "");
const milliseconds = (ns) => (ns === undefined ? null : Number(ns) / 1e6);

/** One touch event; `coalesced` holds the merged older ones, `late` marks one that must not act. */
export function readEvent(raw, late = false) {
  return {
    type: name(raw.type),
    pointerId: raw.pointerId ?? 0,
    contactId: raw.contactId ?? 0,
    timestampMs: milliseconds(raw.timestampNs ?? "0"),
    downTimeMs: milliseconds(raw.downTimeNs),
    hand: name(raw.hand),
    finger: name(raw.finger),
    surface: name(raw.surface),
    touchProbability: raw.touchProbability ?? 0,
    forceN: raw.forceN ?? 0,
    xMm: raw.xMm ?? 0,
    yMm: raw.yMm ?? 0,
    dxMm: raw.dxMm ?? 0,
    dyMm: raw.dyMm ?? 0,
    velocityXMmS: raw.velocityXMmS ?? 0,
    velocityYMmS: raw.velocityYMmS ?? 0,
    pitchRad: raw.pitchRad ?? 0,
    yawRad: raw.yawRad ?? 0,
    imageX: raw.imageX ?? 0,
    imageY: raw.imageY ?? 0,
    clickCount: raw.clickCount ?? 0,
    reason: raw.reason ? name(raw.reason) : null,
    coalesced: (raw.coalesced ?? []).map((older) => readEvent(older, late)),
    late,
  };
}

/** A server's message as `{kind, offset, body}`; `kind` is null for one that this page does not know. */
export function readMessage(text) {
  const raw = JSON.parse(text);
  const offset = raw.offset ?? "0";
  for (const [kind, read] of Object.entries(READERS)) {
    if (raw[kind] !== undefined) return { kind, offset, body: read(raw[kind]) };
  }
  return { kind: null, offset, body: null };
}

const READERS = {
  welcome: (raw) => ({
    epoch: raw.epoch ?? "0",
    recovered: raw.recovered ?? false,
    resumeRequested: raw.resumeRequested ?? false,
    serverVersion: raw.serverVersion ?? "",
    heartbeatMs: raw.heartbeatMs ?? 2000,
    activeHeartbeatMs: raw.activeHeartbeatMs ?? 100,
    inputTtlMs: raw.inputTtlMs ?? 0,
    features: raw.features ?? [],
    settings: { forceEnterN: raw.settings?.forceEnterN ?? 0, forceMaxN: raw.settings?.forceMaxN ?? 3.5 },
    token: raw.token ?? null,
  }),
  batch: (raw) => ({
    frameIndex: Number(raw.frameIndex ?? 0),
    timestampMs: milliseconds(raw.timestampNs ?? "0"),
    sentMs: milliseconds(raw.sentNs ?? "0"),
    events: (raw.events ?? []).map((event) => readEvent(event, raw.late ?? false)),
  }),
  heartbeat: (raw) => ({ activeContacts: raw.activeContacts ?? 0 }),
  clockReply: (raw) => ({
    clientSendMs: milliseconds(raw.clientSendNs ?? "0"),
    serverReceiveMs: milliseconds(raw.serverReceiveNs ?? "0"),
    serverSendMs: milliseconds(raw.serverSendNs ?? "0"),
  }),
  warning: (raw) => ({ code: raw.code ?? "", message: raw.message ?? "" }),
  status: (raw) => ({
    fps: raw.fps ?? 0,
    captureToSendP50Ms: raw.captureToSendP50Ms ?? 0,
    captureToSendP95Ms: raw.captureToSendP95Ms ?? 0,
    handsInView: raw.handsInView ?? 0,
    gate: name(raw.gate),
    merged: Number(raw.merged ?? 0),
    source: raw.source ?? "",
  }),
  hands: (raw) => ({
    widthPx: raw.widthPx ?? 1,
    heightPx: raw.heightPx ?? 1,
    hands: (raw.hands ?? []).map((hand) => ({ handedness: name(hand.handedness), landmarksPx: hand.landmarksPx ?? [] })),
  }),
};

/** Client time in milliseconds as the decimal nanoseconds that a 64-bit field is written with. */
export const nanoseconds = (ms) => Math.round(ms * 1e6).toString();
