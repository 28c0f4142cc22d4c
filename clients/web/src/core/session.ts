// One client of one server over any number of connections: hello, resume, clock, heartbeats, back-off, and the promise that no contact
// outlives the link. No sockets, no clock, no timers: bytes and times go in, effects come out. The table of states:
//
//   disconnected  no connection, none being made; after a loss the next try is waited for
//   connecting    a connection is being made, or waits for its Welcome
//   live          the server speaks
//   stale         the server fell silent while something touched: every contact was cancelled; any message makes it live again

import type { MessageInitShape } from "@bufbuild/protobuf";
import { EgoTouchError } from "../errors.js";
import type { TouchBatch } from "../events.js";
import type { EventBatch, HelloSchema, ServerMessage, Welcome } from "../gen/egotouch/v1/egotouch_pb.js";
import { decodeServerMessage, encodeClientMessage, type ClientBody } from "../wire/messages.js";
import { readEvents } from "../wire/read_event.js";
import { BackOff } from "./back_off.js";
import { ClockOffset, millisecondsOf, nanosecondsOf } from "./clock_offset.js";
import { closeAdvice } from "./close_codes.js";
import type { ConnectionState, Effect, SessionOptions, Subscribe } from "./effects.js";
import { OpenPointers } from "./open_pointers.js";
import { GrammarVerifier } from "./verifier.js";

/** This much silence ends every contact, and everything that a lost connection left open. */
export const SILENCE_MS = 300;
/** Silence of this many heartbeats while nothing touches ends the connection. */
const SILENT_HEARTBEATS = 2.5;
const WELCOME_TIMEOUT_MS = 8000;
/** A tick that comes late may have overtaken messages that wait to be read: silence counts from the second one on. */
const TICKS_OF_SILENCE = 2;
const PROBES_AT_START = 8;
const FIRST_PROBES_EVERY_MS = 100;
const PROBE_EVERY_MS = 1000;

type Link = "none" | "opening" | "open";

export class Session {
  readonly clock = new ClockOffset();
  readonly pointers = new OpenPointers();
  /** Secrets for the next Hello; a pairing code goes before a token. */
  token = "";
  pairingCode = "";
  /** Times that a connection was lost and tried again, and contacts that ended here. */
  reconnects = 0;
  cancelledHere = 0;

  readonly #options: SessionOptions;
  readonly #backOff: BackOff;
  readonly #verifier: GrammarVerifier | null;
  #subscribe: Subscribe;
  #state: ConnectionState = "disconnected";
  #detail = "";
  #link: Link = "none";
  #welcome: Welcome | null = null;
  #epoch: bigint | null = null;
  #offset = 0n;
  #retryAtMs: number | null = null;
  #openedMs = 0;
  #helloMs = 0;
  #heardMs = 0;
  #silentTicks = 0;
  #probedMs = 0;
  #probes = 0;

  constructor(options: SessionOptions) {
    this.#options = options;
    this.#subscribe = options.subscribe;
    this.#backOff = new BackOff(options.random);
    this.#verifier = options.debug ? new GrammarVerifier(!options.subscribe.types?.length) : null;
  }

  get state(): ConnectionState {
    return this.#state;
  }

  /** One sentence for the user. */
  get detail(): string {
    return this.#detail;
  }

  /** The server's Welcome; null while there is no live connection. */
  get welcome(): Welcome | null {
    return this.#welcome;
  }

  /** Connect, or connect anew at once; what is open here ends. */
  start(nowMs: number): Effect[] {
    const effects: Effect[] = this.#link === "none" ? [] : [{ kind: "close" }];
    effects.push(...this.#endAll());
    this.#backOff.reset();
    return [...effects, ...this.#open(nowMs)];
  }

  /** Disconnect for good; what is open here ends. */
  stop(): Effect[] {
    const effects: Effect[] = this.#link === "none" ? [] : [{ kind: "close" }];
    this.#forgetLink();
    this.#retryAtMs = null;
    return [...effects, ...this.#endAll(), ...this.#change("disconnected", "Stopped.")];
  }

  /** Do not wait for the next try, as when the network has come back. */
  retryNow(nowMs: number): Effect[] {
    if (this.#retryAtMs === null) return [];
    this.#backOff.reset();
    return this.#open(nowMs);
  }

  /** Change what the server sends. */
  subscribe(subscribe: Subscribe): Effect[] {
    this.#subscribe = subscribe;
    return this.send({ case: "subscribe", value: subscribe });
  }

  /** Send a message; nothing where there is no live connection. */
  send(body: ClientBody): Effect[] {
    return this.#welcome ? [{ kind: "send", data: encodeClientMessage(body) }] : [];
  }

  /** The connection is made. */
  opened(nowMs: number): Effect[] {
    this.#link = "open";
    this.#helloMs = nowMs;
    return [{ kind: "send", data: encodeClientMessage({ case: "hello", value: this.#hello() }) }];
  }

  /** One message has come. A malformed one ends the connection, and nothing of it reaches the app. */
  received(data: Uint8Array, nowMs: number): Effect[] {
    if (this.#link !== "open") return [];
    let effects: Effect[];
    try {
      effects = this.#take(decodeServerMessage(data), nowMs);
    } catch (error) {
      if (!(error instanceof EgoTouchError)) throw error;
      return [{ kind: "error", error }, ...this.#abandon("The server sent something that is no message.", nowMs)];
    }
    this.#heardMs = nowMs;
    this.#silentTicks = 0;
    return this.#state === "stale" ? [...this.#change("live", "Connected."), ...effects] : effects;
  }

  /** The connection is gone, or could not be made. */
  closed(code: number, reason: string, nowMs: number): Effect[] {
    if (this.#link === "none") return [];
    const advice = closeAdvice(code, reason, this.#welcome !== null, this.#options.noAnswer);
    if (advice.retry) return this.#lost(advice.text, nowMs);
    this.#forgetLink();
    const effects = [...this.#endAll(), ...this.#change("disconnected", advice.text)];
    if (advice.access) {
      this.token = this.pairingCode = "";
      effects.push({ kind: "access", reason: advice.text });
    }
    return effects;
  }

  /** Time has passed; to be called about twenty times a second. */
  tick(nowMs: number): Effect[] {
    this.#silentTicks += 1;
    const silentMs = this.#silentTicks < TICKS_OF_SILENCE ? 0 : nowMs - this.#heardMs;
    if (this.#retryAtMs !== null && nowMs >= this.#retryAtMs) return [...this.#endUnheard(silentMs), ...this.#open(nowMs)];
    if (this.#link === "none") return this.#endUnheard(silentMs);
    if (!this.#welcome) {
      if (nowMs - this.#openedMs > WELCOME_TIMEOUT_MS) return this.#abandon("The server does not answer.", nowMs);
      return this.#endUnheard(silentMs);
    }
    if (silentMs > SILENCE_MS && this.pointers.contacts > 0) {
      return [...this.#endAll(), ...this.#change("stale", "No word from the server; touches were cancelled.")];
    }
    if (silentMs > SILENT_HEARTBEATS * this.#welcome.heartbeatMs) return this.#abandon("The server has fallen silent.", nowMs);
    return this.#probe(nowMs);
  }

  #hello(): MessageInitShape<typeof HelloSchema> {
    const { name, version } = this.#options;
    return {
      client: name,
      version,
      token: this.pairingCode ? "" : this.token,
      pairingCode: this.pairingCode,
      subscribe: this.#subscribe,
      ...(this.#epoch === null ? {} : { resume: { epoch: this.#epoch, offset: this.#offset, held: this.pointers.held.map((held) => ({ ...held })) } }),
    };
  }

  #take({ body, offset }: ServerMessage, nowMs: number): Effect[] {
    if (body.case === "welcome") return this.#welcomed(body.value, offset, nowMs);
    if (!this.#welcome) throw new EgoTouchError("protocol", `a ${body.case ?? "message of an unknown kind"} came before the Welcome`);
    let effects: Effect[] = [];
    switch (body.case) {
      case "batch":
        effects = this.#batch(body.value, nowMs);
        break;
      case "clockReply": {
        const { clientSendNs, serverReceiveNs, serverSendNs } = body.value;
        this.clock.add({
          clientSendMs: millisecondsOf(clientSendNs),
          serverReceiveMs: millisecondsOf(serverReceiveNs),
          serverSendMs: millisecondsOf(serverSendNs),
          clientReceiveMs: nowMs,
        });
        break;
      }
      case "status":
        effects = [{ kind: "status", status: body.value }];
        break;
      case "hands":
        effects = [{ kind: "hands", hands: body.value }];
        break;
      case "warning":
        effects = [{ kind: "warning", warning: body.value }];
        break;
    }
    this.#offset = offset;
    return effects;
  }

  #welcomed(welcome: Welcome, offset: bigint, nowMs: number): Effect[] {
    const effects = welcome.recovered ? [] : this.#endAll();
    if (welcome.recovered) this.#verifier?.resume();
    if (this.#epoch !== welcome.epoch) this.clock.reset();
    const serverMs = millisecondsOf(welcome.serverNowNs);
    this.clock.add({ clientSendMs: this.#helloMs, serverReceiveMs: serverMs, serverSendMs: serverMs, clientReceiveMs: nowMs });
    this.#welcome = welcome;
    this.#epoch = welcome.epoch;
    this.#offset = offset;
    this.#probes = 0;
    if (welcome.token) {
      this.token = welcome.token;
      this.pairingCode = "";
      effects.push({ kind: "token", token: welcome.token });
    }
    return [...effects, ...this.#change("live", "Connected."), { kind: "welcome", welcome }];
  }

  #batch(batch: EventBatch, nowMs: number): Effect[] {
    const serverMs = this.clock.toServerMs(nowMs);
    const latencyMs = (timestampNs: bigint) => (serverMs === null ? null : serverMs - millisecondsOf(timestampNs));
    const events = readEvents(batch.events, { late: batch.late, latencyMs });
    const heard = this.pointers.apply(events, !batch.late && this.#isStale(batch, nowMs));
    if (!heard.length) return [];
    const sendMs = millisecondsOf(batch.sentNs - batch.timestampNs);
    const told = { frameIndex: batch.frameIndex, timestampNs: batch.timestampNs, sendMs, latencyMs: latencyMs(batch.timestampNs) };
    return this.#tell({ events: heard, ...told, late: batch.late, local: false });
  }

  /** True when a batch was under way for longer than input may be, by more than the clock may err. */
  #isStale(batch: EventBatch, nowMs: number): boolean {
    const serverMs = this.clock.toServerMs(nowMs);
    const limitMs = this.#options.inputTtlMs ?? this.#welcome?.inputTtlMs ?? 0;
    if (serverMs === null || limitMs === 0) return false;
    return serverMs - millisecondsOf(batch.sentNs) - (this.clock.uncertaintyMs ?? 0) > limitMs;
  }

  #probe(nowMs: number): Effect[] {
    const everyMs = this.#probes < PROBES_AT_START ? FIRST_PROBES_EVERY_MS : PROBE_EVERY_MS;
    if (nowMs - this.#probedMs < everyMs) return [];
    this.#probedMs = nowMs;
    this.#probes += 1;
    return this.send({ case: "clockRequest", value: { clientSendNs: nanosecondsOf(nowMs) } });
  }

  #open(nowMs: number): Effect[] {
    this.#welcome = null;
    this.#retryAtMs = null;
    this.#link = "opening";
    this.#openedMs = nowMs;
    return [...this.#change("connecting", "Connecting to the server …"), { kind: "open" }];
  }

  /** Give a connection up without waiting for it to be noticed. */
  #abandon(why: string, nowMs: number): Effect[] {
    return [{ kind: "close" }, ...this.#lost(why, nowMs)];
  }

  /** A connection is gone and shall be made again; what is open here goes on if that succeeds within the silence that is allowed. */
  #lost(why: string, nowMs: number): Effect[] {
    if (this.#welcome) this.#backOff.heldFor(nowMs - this.#openedMs);
    this.#forgetLink();
    this.reconnects += 1;
    this.#retryAtMs = nowMs + this.#backOff.next();
    return this.#change("disconnected", `${why} Trying again …`);
  }

  #forgetLink(): void {
    this.#link = "none";
    this.#welcome = null;
  }

  #endUnheard(silentMs: number): Effect[] {
    return silentMs > SILENCE_MS ? this.#endAll() : [];
  }

  /** End what is open here. */
  #endAll(): Effect[] {
    const events = this.pointers.endAll();
    const last = events.at(-1);
    if (!last) return [];
    this.cancelledHere += events.filter((event) => event.type === "cancel").length;
    return this.#tell({ events, frameIndex: 0n, timestampNs: last.timestampNs, sendMs: null, latencyMs: null, late: false, local: true });
  }

  #tell(batch: TouchBatch): Effect[] {
    const violations = this.#verifier?.feed(batch.events) ?? [];
    return [{ kind: "batch", batch }, ...violations.map((violation): Effect => ({ kind: "violation", violation }))];
  }

  #change(state: ConnectionState, detail: string): Effect[] {
    if (state === this.#state && detail === this.#detail) return [];
    this.#state = state;
    this.#detail = detail;
    return [{ kind: "state", state, detail }];
  }
}
