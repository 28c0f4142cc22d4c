// The client that apps use: a WebSocket and a timer around the session, and listeners behind it.

import type { ConnectionState, Effect, Subscribe } from "./core/effects.js";
import { Session } from "./core/session.js";
import { EgoTouchError } from "./errors.js";
import { isStream, type EventType, type TouchBatch, type TouchEvent } from "./events.js";
import type { Status, Welcome } from "./gen/egotouch/v1/egotouch_pb.js";
import { ConnectionListeners, type StateEvent } from "./listeners/connection_listeners.js";
import { EventQueue } from "./listeners/event_queue.js";
import { accepting, type EventFilter } from "./listeners/filters.js";
import { METHODS, type TrackingState } from "./listeners/touch_listener.js";
import { EVENT_TYPES, GATE_REASONS } from "./wire/enums.js";
import type { ClientBody } from "./wire/messages.js";
import { checkAddress, noAnswerAt, sameOrigin, systemClock, type Clock, type SocketConstructor } from "./platform.js";

const SUBPROTOCOL = "egotouch.v1.pb";
const TICK_MS = 50;
const CLICKS: ReadonlySet<EventType> = new Set(["click", "double_click"]);
const RAW: ReadonlySet<EventType> = new Set(["down", "move", "up", "cancel"]);

export interface ClientOptions {
  /** `ws://` or `wss://` address of the server; by default the one that sent this page. */
  readonly url?: string | URL;
  /** From the server's start-up, where it wants one; kept in this object only. */
  readonly token?: string;
  /** Six digits that the server shows; exchanged for a token, which `onToken` hears. */
  readonly pairingCode?: string;
  /** Name and version of the app, for the server's log. */
  readonly name?: string;
  readonly version?: string;
  /** Less, or more (`status`, `landmarks`, `lateEdges`), than every event. */
  readonly subscribe?: Subscribe;
  /** Check the event grammar; what breaks it reaches `onError`. */
  readonly debug?: boolean;
  /** Events older than this on arrival do not act, in milliseconds; by default the server's limit, `Infinity` for none. */
  readonly inputTtlMs?: number;
  /** The WebSocket class, where there is no global one (Node 20: that of the package `ws`). */
  readonly WebSocket?: SocketConstructor;
  /** Time and timers; for tests. */
  readonly clock?: Clock;
  /** Numbers in [0, 1) for the pauses between tries; for tests. */
  readonly random?: () => number;
}

/** Counts for a status line. */
export interface ClientStats {
  readonly edges: number;
  readonly moves: number;
  /** Older moves that came inside newer ones. */
  readonly merged: number;
  /** Events of contacts that had ended here, or that came too late. */
  readonly dropped: number;
  /** Contacts that this client ended by itself. */
  readonly cancelledHere: number;
  readonly reconnects: number;
  readonly listenerErrors: number;
}

export class EgoTouchClient extends ConnectionListeners {
  readonly #session: Session;
  readonly #options: ClientOptions;
  readonly #clock: Clock;
  readonly #queues = new Set<EventQueue>();
  #subscribe: Subscribe;
  #socket: WebSocket | null = null;
  #timer: unknown = null;
  #unhook: () => void = () => {};
  #consumed = new Map<number, number>();
  #gate: string | null = null;
  #effects: Effect[] = [];
  #isRunning = false;
  #counts = { edges: 0, moves: 0, merged: 0 };

  constructor(options: ClientOptions = {}) {
    super();
    if (options.url !== undefined) checkAddress(options.url);
    this.#options = options;
    this.#clock = options.clock ?? systemClock;
    this.#subscribe = options.subscribe ?? {};
    this.#session = new Session({
      name: options.name ?? "web",
      version: options.version ?? "",
      subscribe: this.#subscribe,
      debug: options.debug ?? false,
      inputTtlMs: options.inputTtlMs ?? null,
      random: options.random ?? Math.random,
      noAnswer: noAnswerAt(options.url),
    });
    this.#session.token = options.token ?? "";
    this.#session.pairingCode = options.pairingCode ?? "";
  }

  get state(): ConnectionState {
    return this.#session.state;
  }

  /** One sentence about the state for the user. */
  get detail(): string {
    return this.#session.detail;
  }

  /** The server's Welcome (thresholds, features, a snapshot to draw); null while not connected. */
  get welcome(): Welcome | null {
    return this.#session.welcome;
  }

  /** Number of contacts that are down. */
  get contacts(): number {
    return this.#session.pointers.contacts;
  }

  /** The last event of every open pointer. */
  get pointers(): readonly TouchEvent[] {
    return this.#session.pointers.events;
  }

  get stats(): ClientStats {
    const { pointers, cancelledHere, reconnects } = this.#session;
    return { ...this.#counts, dropped: pointers.dropped, cancelledHere, reconnects, listenerErrors: this.registry.errors };
  }

  /** The greatest error of all latencies, in milliseconds; null before the first answer. */
  get clockUncertaintyMs(): number | null {
    return this.#session.clock.uncertaintyMs;
  }

  /** The server's monotonic clock now, in milliseconds; null before the first answer. */
  get serverTimeMs(): number | null {
    return this.#session.clock.toServerMs(this.#clock.nowMs());
  }

  /** Connect and stay connected. When it is connected already: connect anew, with whatever token or code is set by now. */
  start(access: { token?: string; pairingCode?: string } = {}): this {
    if (access.token !== undefined) this.#session.token = access.token;
    if (access.pairingCode !== undefined) this.#session.pairingCode = access.pairingCode;
    this.#timer ??= this.#clock.setInterval(() => this.#run(this.#session.tick(this.#clock.nowMs())), TICK_MS);
    this.#unhook();
    this.#unhook = onReturn(() => this.#run(this.#session.retryNow(this.#clock.nowMs())));
    this.#run(this.#session.start(this.#clock.nowMs()));
    return this;
  }

  /** Disconnect; what is open is cancelled, and iterators end. */
  stop(): void {
    this.#run(this.#session.stop());
    if (this.#timer !== null) this.#clock.clearInterval(this.#timer);
    this.#timer = null;
    this.#unhook();
    for (const queue of this.#queues) queue.finish();
  }

  /** Change what the server sends. */
  subscribe(subscribe: Subscribe): void {
    this.#subscribe = subscribe;
    this.#run(this.#session.subscribe(subscribe));
  }

  /** Send one message, such as `{ case: "simulated", value: { pointers: [] } }`; false when there is no live connection. */
  send(body: ClientBody): boolean {
    const effects = this.#session.send(body);
    this.#run(effects);
    return effects.length > 0;
  }

  /** Bytes that wait to be sent. */
  get bufferedAmount(): number {
    return this.#socket?.bufferedAmount ?? 0;
  }

  /** Events as an async iterator, until `signal` aborts, the loop is left or the client stops. Moves merge while the loop is busy. */
  events(options: EventFilter & { readonly types?: readonly EventType[]; readonly signal?: AbortSignal } = {}): AsyncIterableIterator<TouchEvent> {
    const unknown = options.types?.find((type) => !EVENT_TYPES.names.includes(type));
    if (unknown) throw new EgoTouchError("config", `there is no event "${unknown}"`, `Give some of ${EVENT_TYPES.names.join(", ")}`);
    const types = options.types && new Set(options.types);
    const accepts = accepting(options);
    const queue = new EventQueue(() => {
      subscription.remove();
      this.#queues.delete(queue);
      options.signal?.removeEventListener("abort", abort);
    });
    const abort = () => queue.finish();
    const wanted = (event: TouchEvent) => (types?.has(event.type) ?? true) && accepts(event);
    const subscription = this.registry.add("onEvent", (event: TouchEvent) => queue.push(event), wanted);
    this.#queues.add(queue);
    options.signal?.addEventListener("abort", abort);
    if (options.signal?.aborted) abort();
    return queue;
  }

  protected override wantStatus(): void {
    if (!this.#subscribe.status) this.subscribe({ ...this.#subscribe, status: true });
  }

  /** Work through effects in order; those that listeners bring about come after them. */
  #run(effects: readonly Effect[]): void {
    this.#effects.push(...effects);
    if (this.#isRunning) return;
    this.#isRunning = true;
    try {
      for (let effect = this.#effects.shift(); effect; effect = this.#effects.shift()) this.#perform(effect);
    } finally {
      this.#isRunning = false;
    }
  }

  #perform(effect: Effect): void {
    switch (effect.kind) {
      case "open":
        return this.#open();
      case "send":
        if (this.#socket?.readyState === 1) this.#socket.send(effect.data);
        return;
      case "close":
        return this.#close();
      case "state":
        this.registry.call<StateEvent>("onState", { state: effect.state, detail: effect.detail });
        return;
      case "welcome":
        this.registry.call("onWelcome", effect.welcome);
        return;
      case "token":
        this.registry.call("onToken", effect.token);
        return;
      case "access":
        this.registry.call("onAccessWanted", effect.reason);
        return;
      case "batch":
        return this.#deliver(effect.batch);
      case "status":
        return this.#tellStatus(effect.status);
      case "hands":
        this.registry.call("onHands", effect.hands);
        return;
      case "warning":
        this.registry.call("onWarning", effect.warning);
        return;
      case "violation": {
        const error = new EgoTouchError("grammar", effect.violation.rule);
        return this.registry.report({ error, listener: null, event: effect.violation.event });
      }
      case "error":
        return this.registry.report({ error: effect.error, listener: null, event: null });
    }
  }

  #open(): void {
    const WebSocketClass = this.#options.WebSocket ?? (globalThis.WebSocket as SocketConstructor | undefined);
    if (!WebSocketClass) throw new EgoTouchError("config", "there is no WebSocket here", "Pass the option WebSocket, such as that of the package ws");
    let socket: WebSocket;
    try {
      socket = new WebSocketClass(this.#options.url ?? sameOrigin(), SUBPROTOCOL) as WebSocket;
    } catch (error) {
      if (error instanceof EgoTouchError) throw error;
      this.#run(this.#session.closed(1006, "", this.#clock.nowMs())); // browsers refuse ws:// from some https pages right here
      return;
    }
    socket.binaryType = "arraybuffer";
    this.#socket = socket;
    const ifCurrent = (work: () => Effect[]) => socket === this.#socket && this.#run(work());
    socket.onopen = () => ifCurrent(() => this.#session.opened(this.#clock.nowMs()));
    socket.onmessage = ({ data }: { data: unknown }) => ifCurrent(() => this.#session.received(bytesOf(data), this.#clock.nowMs()));
    socket.onclose = ({ code, reason }: { code: number; reason: string }) =>
      ifCurrent(() => {
        this.#socket = null;
        return this.#session.closed(code, reason, this.#clock.nowMs());
      });
    socket.onerror = () => {}; // a close follows, and says more
  }

  #close(): void {
    const socket = this.#socket;
    this.#socket = null;
    socket?.close();
  }

  #tellStatus(status: Status): void {
    const gate = GATE_REASONS.name(status.gate) ?? "no_hands";
    const key = `${gate} ${status.handsInView}`;
    const hasChanged = key !== this.#gate;
    this.#gate = key;
    if (hasChanged) this.registry.call<TrackingState>("onTrackingChanged", { gate, handsInView: status.handsInView });
    this.registry.call("onStatus", status);
  }

  #deliver(batch: TouchBatch): void {
    for (const event of batch.events) {
      this.#counts[isStream(event.type) ? "moves" : "edges"] += 1;
      this.#counts.merged += event.coalesced.length;
    }
    this.registry.call("onBatch", batch);
    for (const event of batch.events) {
      this.registry.call("onEvent", event);
      if (event.late) this.registry.call("onLate", event);
      else this.#deliverEvent(event);
    }
  }

  #deliverEvent(event: TouchEvent): void {
    if (RAW.has(event.type)) this.registry.call("onTouch", event);
    if (CLICKS.has(event.type) && this.#consumed.get(event.pointerId) === event.contactId) return;
    const results = this.registry.call(METHODS[event.type], event);
    if (event.type === "long_click" && results.includes(true)) this.#consumed.set(event.pointerId, event.contactId);
    if (event.type === "hover_exit") this.#consumed.delete(event.pointerId);
  }
}

function bytesOf(data: unknown): Uint8Array {
  if (data instanceof ArrayBuffer) return new Uint8Array(data);
  if (ArrayBuffer.isView(data)) return new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
  return new TextEncoder().encode(String(data)); // no message, and refused as such
}

/** Call `work` when the network or the page comes back; gives what undoes it. */
function onReturn(work: () => void): () => void {
  if (typeof document === "undefined") return () => {};
  const visible = () => document.visibilityState === "visible" && work();
  addEventListener("online", work);
  document.addEventListener("visibilitychange", visible);
  return () => {
    removeEventListener("online", work);
    document.removeEventListener("visibilitychange", visible);
  };
}
