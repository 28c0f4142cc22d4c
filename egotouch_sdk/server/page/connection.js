// One connection to the event server, kept up for as long as the page lives: hello, subscribe, resume, heartbeats, clock, back-off,
// and the promise that no contact outlives the link. Views listen to its events and know nothing of the protocol.
//
//   state    {state, detail}     "disconnected" | "connecting" | "live" | "stale", with one sentence for the user
//   access   {reason}            the server wants a token or pairing code; call `start` again once there is one
//   welcome  the Welcome         settings, features, epoch
//   events   {events, local}     what happened, in order; `local` is true for CANCELs made here
//   timing   {ageMs, sendMs, uncertaintyMs}   capture to arrival, capture to sending, error bound of the clock
//   status, hands, warning       as the server sent them

import { closeAdvice } from "./close_codes.js";
import { ClockOffset } from "./clock_offset.js";
import { OpenPointers } from "./open_pointers.js";
import { nanoseconds, readMessage } from "./wire.js";

const SUBPROTOCOL = "egotouch.v1.json";
/** While something touches, this much silence cancels every contact. */
const SILENCE_WHILE_TOUCHING_MS = 300;
/** Without touches, the link counts as stale after this many heartbeats, and as dead after twice as many. */
const SILENT_HEARTBEATS = 2.5;
const BACKOFF_FIRST_MS = 250;
const BACKOFF_MAX_MS = 5000;
const WELCOME_TIMEOUT_MS = 8000;
const WATCH_EVERY_MS = 50;
const PROBES_AT_START = 8;
const PROBE_EVERY_MS = 250;

/** Numbers for counters: merged are older moves that came inside newer ones, dropped belong to contacts that had ended here. */
const NOTHING_YET = { edges: 0, moves: 0, merged: 0, dropped: 0, cancelledHere: 0, reconnects: 0 };

export class Connection extends EventTarget {
  #options;
  #socket = null;
  #state = "connecting";
  #detail = "";
  #welcome = null;
  #resume = null;
  #attempt = 0;
  #retryTimer = 0;
  #opened = 0;
  #heard = 0;
  #watched = 0;
  #probed = 0;
  #probes = 0;

  counts = { ...NOTHING_YET };
  clock = new ClockOffset();
  pointers = new OpenPointers();

  /** `url`, `client` (name in the Hello), `subscribe` (fields of Subscribe) and `access()`, which gives `{token, pairing_code}`. */
  constructor(options) {
    super();
    this.#options = { subscribe: {}, access: () => ({}), keepToken: () => {}, ...options };
    setInterval(() => this.#watch(performance.now()), WATCH_EVERY_MS);
    addEventListener("online", () => this.#retryNow());
    document.addEventListener("visibilitychange", () => document.visibilityState === "visible" && this.#retryNow());
  }

  get state() {
    return this.#state;
  }

  get detail() {
    return this.#detail;
  }

  get welcome() {
    return this.#welcome;
  }

  /** Connect, or connect again at once; what touches on this page is cancelled. */
  start() {
    clearTimeout(this.#retryTimer);
    this.#retryTimer = 0;
    const old = this.#socket;
    this.#socket = null;
    old?.close();
    this.#end();
    this.#open();
  }

  /** Send one ClientMessage body, for example `{simulated: {pointers: []}}`; false when there is no live link. */
  send(message) {
    if (this.#socket?.readyState !== WebSocket.OPEN || !this.#welcome) return false;
    this.#socket.send(JSON.stringify(message));
    return true;
  }

  #open() {
    const socket = new WebSocket(this.#options.url, SUBPROTOCOL);
    this.#socket = socket;
    this.#welcome = null;
    this.#opened = this.#heard = performance.now();
    this.#change("connecting", "Connecting to the server …");
    socket.onopen = () => socket.send(JSON.stringify({ hello: this.#hello() }));
    socket.onmessage = ({ data }) => socket === this.#socket && this.#receive(data);
    socket.onclose = ({ code, reason }) => socket === this.#socket && this.#closed(code, reason);
  }

  #hello() {
    const hello = { client: this.#options.client, version: "1", subscribe: this.#options.subscribe };
    const { token, pairing_code } = this.#options.access();
    if (token) hello.token = token;
    else if (pairing_code) hello.pairing_code = pairing_code;
    if (this.#resume) hello.resume = this.#resume;
    return hello;
  }

  #receive(text) {
    const now = performance.now();
    let message;
    try {
      message = readMessage(text);
    } catch {
      this.#abandon("The server sent something that is no message.");
      return;
    }
    this.#heard = now;
    if (this.#state === "stale") this.#change("live", "Connected.");
    if (message.kind === "welcome") this.#welcomed(message.body);
    if (this.#welcome) this.#resume = { epoch: this.#welcome.epoch, offset: message.offset };
    if (message.kind === "batch") this.#batch(message.body, now);
    else if (message.kind === "clock_reply") this.clock.add(message.body, now);
    else if (message.kind === "status" || message.kind === "hands" || message.kind === "warning") this.#emit(message.kind, message.body);
  }

  #welcomed(welcome) {
    if (this.#resume && this.#resume.epoch !== welcome.epoch) this.clock.reset();
    this.#welcome = welcome;
    this.#probes = 0;
    if (welcome.token) this.#options.keepToken(welcome.token);
    this.#change("live", "Connected.");
    this.#emit("welcome", welcome);
  }

  #batch(batch, now) {
    const events = batch.events.filter((event) => event.late || this.pointers.accept(event));
    this.counts.dropped += batch.events.length - events.length;
    for (const event of events) {
      if (isStream(event.type)) this.counts.moves += 1;
      else this.counts.edges += 1;
      this.counts.merged += event.coalesced.length;
    }
    this.#tell(events, false);
    const serverNow = this.clock.toServerMs(now);
    if (serverNow !== null && !batch.events.some((event) => event.late)) {
      const { uncertaintyMs } = this.clock;
      this.#emit("timing", { ageMs: serverNow - batch.timestamp_ms, sendMs: batch.sent_ms - batch.timestamp_ms, uncertaintyMs });
    }
  }

  #watch(now) {
    const pageSlept = now - this.#watched > 3 * WATCH_EVERY_MS; // what has come meanwhile is still to be read: not silence
    this.#watched = now;
    if (this.#socket === null || pageSlept) return;
    if (!this.#welcome) {
      if (now - this.#opened > WELCOME_TIMEOUT_MS) this.#abandon("The server does not answer.");
      return;
    }
    const silenceMs = now - this.#heard;
    const idleMs = SILENT_HEARTBEATS * this.#welcome.heartbeat_ms;
    if (silenceMs > 2 * idleMs) {
      this.#abandon("The server has fallen silent.");
    } else if (silenceMs > (this.pointers.contacts ? SILENCE_WHILE_TOUCHING_MS : idleMs)) {
      this.#cancelHere(this.pointers.cancelContacts());
      this.#change("stale", "No word from the server; touches were cancelled.");
    }
    const probeEveryMs = this.#probes < PROBES_AT_START ? 2 * WATCH_EVERY_MS : PROBE_EVERY_MS;
    if (now - this.#probed >= probeEveryMs && this.send({ clock_request: { client_send_ns: nanoseconds(performance.now()) } })) {
      this.#probed = now;
      this.#probes += 1;
    }
  }

  /** Give a silent link up without waiting for the browser to notice. */
  #abandon(why) {
    const socket = this.#socket;
    this.#socket = null;
    socket.close();
    this.#lost(why);
  }

  #closed(code, reason) {
    this.#socket = null;
    const advice = closeAdvice(code, reason, this.#welcome !== null);
    if (advice.retry) {
      this.#lost(advice.text);
      return;
    }
    this.#end();
    this.#change("disconnected", advice.text);
    if (advice.access) this.#emit("access", { reason: advice.text });
  }

  #lost(why) {
    this.#end();
    this.counts.reconnects += 1;
    if (performance.now() - this.#opened > BACKOFF_MAX_MS) this.#attempt = 0; // it held for a while
    const waitMs = Math.random() * Math.min(BACKOFF_MAX_MS, BACKOFF_FIRST_MS * 2 ** this.#attempt); // full jitter
    this.#attempt += 1;
    this.#change("disconnected", `${why} Trying again …`);
    clearTimeout(this.#retryTimer);
    this.#retryTimer = setTimeout(() => {
      this.#retryTimer = 0;
      this.#open();
    }, waitMs);
  }

  #retryNow() {
    if (!this.#retryTimer) return;
    this.#attempt = 0;
    this.start();
  }

  #end() {
    this.#welcome = null;
    this.#cancelHere(this.pointers.clear());
  }

  #cancelHere(events) {
    this.counts.cancelledHere += events.filter((event) => event.type === "CANCEL").length;
    this.#tell(events, true);
  }

  #tell(events, local) {
    if (events.length) this.#emit("events", { events, local });
  }

  #change(state, detail) {
    if (state === this.#state && detail === this.#detail) return;
    this.#state = state;
    this.#detail = detail;
    this.#emit("state", { state, detail });
  }

  #emit(type, detail) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}

/** True for the events that may be merged for a slow page. */
export function isStream(type) {
  return type === "MOVE" || type === "HOVER_MOVE" || type === "DRAG" || type === "FORCE_CHANGE";
}

/** Where the server that sent this page listens. */
export function sameOrigin() {
  return `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/`;
}
