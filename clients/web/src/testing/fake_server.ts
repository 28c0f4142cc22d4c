// An egotouch server without a network, for the tests of apps: it speaks the protocol's binary form to real clients, on a clock that
// stands still until the test moves it, and plays the fingers that the test moves.

import { create, fromBinary, toBinary, type MessageInitShape } from "@bufbuild/protobuf";
import type { ClientOptions, EgoTouchClient } from "../client.js";
import { nanosecondsOf } from "../core/clock_offset.js";
import { ClientMessageSchema, ServerMessageSchema, type ClientMessage, type Hello, type Welcome } from "../gen/egotouch/v1/egotouch_pb.js";
import type { SocketConstructor } from "../platform.js";
import { isStream } from "../events.js";
import { EVENT_TYPES } from "../wire/enums.js";
import { FakeFinger, FORCE_ENTER_N, FORCE_EXIT_N, LONG_PRESS_MS, TOUCH_SLOP_MM, type FingerSettings, type WireEvent } from "./fake_finger.js";
import { FakeSocket, type FakePeer } from "./fake_socket.js";
import { ManualClock } from "./manual_clock.js";

type ServerBody = NonNullable<MessageInitShape<typeof ServerMessageSchema>["body"]>;

/** The server's clock is this far ahead, so that mixing the two up shows. */
const AHEAD_MS = 7_000_000;
const HEARTBEAT_MS = 2000;
const ACTIVE_HEARTBEAT_MS = 100;
const STEP_MS = 10;
/** Never sent to a client that comes back. */
const NEVER_REPLAYED: ReadonlySet<string> = new Set(["click", "double_click", "fling", "long_click"]);

interface Sent {
  readonly offset: bigint;
  readonly timestampNs: bigint;
  readonly events: readonly WireEvent[];
}

export class FakeServer implements FakePeer {
  readonly clock = new ManualClock();
  /** Every message that clients sent, the oldest first. */
  readonly messages: ClientMessage[] = [];
  /** Set to false to refuse new connections. */
  isUp = true;
  /** What the Welcome says besides the usual. */
  welcome: Partial<Pick<Welcome, "features" | "token" | "inputTtlMs" | "serverVersion">> = {};

  #isSilent = false;
  #unsaid: (readonly [FakeSocket, Uint8Array])[] = [];
  #epoch = 1n;
  #offset = 0n;
  #frames = 0n;
  #pointers = 0;
  #sent: Sent[] = [];
  #sockets = new Set<FakeSocket>();
  #live = new Set<FakeSocket>();
  #pending: FakeSocket[] = [];
  #spokeMs = 0;
  #down = new Set<number>();

  /** True while nothing that the server says arrives; it does when this becomes false again, as after a stall of the network. */
  get isSilent(): boolean {
    return this.#isSilent;
  }

  set isSilent(isSilent: boolean) {
    this.#isSilent = isSilent;
    if (!isSilent) for (const [socket, data] of this.#unsaid.splice(0)) socket.deliver(data);
  }

  /** Options that lead a client here: `new EgoTouchClient(server.options())`. */
  options(more: ClientOptions = {}): ClientOptions {
    const server = this;
    class Socket extends FakeSocket {
      constructor(url: string | URL, protocols?: string | string[]) {
        super(server, url, protocols);
      }
    }
    return { url: "ws://fake/", WebSocket: Socket as SocketConstructor, clock: this.clock, random: () => 0.5, debug: true, ...more };
  }

  /** Start a client and let it in. */
  connect(client: EgoTouchClient): void {
    client.start();
    this.#admit();
  }

  /** A finger over the skin; it enters with its first `hover`, `tap`, `press` or `drag`. */
  finger(settings: FingerSettings = {}): FakeFinger {
    this.#pointers += 1;
    const stage = {
      advance: (ms: number) => {
        this.advance(ms);
        return this.#nowNs();
      },
      publish: (events: WireEvent[], timestampNs: bigint) => this.publish(events, timestampNs),
    };
    return new FakeFinger(stage, this.#pointers, settings);
  }

  /** Let time pass, with the heartbeats of a real server; connections that clients ask for meanwhile are made. */
  advance(ms: number): void {
    for (let left = ms; left > 0; left -= STEP_MS) {
      this.clock.advance(Math.min(STEP_MS, left));
      this.#admit();
      const everyMs = this.#down.size ? ACTIVE_HEARTBEAT_MS : HEARTBEAT_MS;
      if (this.clock.nowMs() - this.#spokeMs >= everyMs) this.send({ case: "heartbeat", value: { sentNs: this.#nowNs(), activeContacts: this.#down.size } });
    }
  }

  /** Send the events of one frame to every client. */
  publish(events: WireEvent[], timestampNs = this.#nowNs()): void {
    for (const { type, pointerId = 0 } of events) {
      const name = EVENT_TYPES.name(type ?? 0);
      if (name === "down") this.#down.add(pointerId);
      if (name === "up" || name === "cancel") this.#down.delete(pointerId);
      if (name && !isStream(name)) this.#offset += 1n;
    }
    this.#sent.push({ offset: this.#offset, timestampNs, events });
    this.#frames += 1n;
    this.send({ case: "batch", value: { frameIndex: this.#frames, timestampNs, sentNs: this.#nowNs(), events: [...events] } });
  }

  /** Send any message to every client that is live, such as a Status. */
  send(body: ServerBody): void {
    this.#spokeMs = this.clock.nowMs();
    for (const socket of this.#live) this.#sendTo(socket, body);
  }

  /** Send bytes that may be no message at all. */
  sendBytes(data: Uint8Array): void {
    for (const socket of this.#live) socket.deliver(data);
  }

  /** End every connection. */
  drop(code = 1006, reason = ""): void {
    const sockets = [...this.#sockets];
    this.#sockets.clear();
    this.#live.clear();
    this.#pending = [];
    for (const socket of sockets) socket.end(code, reason);
  }

  /** End as after a crash and start anew: another epoch that remembers nothing. */
  restart(): void {
    this.#epoch += 1n;
    this.#offset = 0n;
    this.#sent = [];
    this.#down.clear();
    this.drop();
  }

  /** The Hello of each connection, the oldest first. */
  get hellos(): Hello[] {
    return this.messages.flatMap(({ body }) => (body.case === "hello" ? [body.value] : []));
  }

  /** Connections that are open. */
  get connections(): number {
    return this.#live.size;
  }

  opened(socket: FakeSocket): void {
    this.#sockets.add(socket);
    this.#pending.push(socket);
  }

  closed(socket: FakeSocket): void {
    this.#sockets.delete(socket);
    this.#live.delete(socket);
    this.#pending = this.#pending.filter((other) => other !== socket);
  }

  received(socket: FakeSocket, data: Uint8Array): void {
    const message = fromBinary(ClientMessageSchema, data);
    this.messages.push(message);
    if (message.body.case === "hello") this.#greet(socket, message.body.value);
    if (message.body.case === "clockRequest") {
      const nowNs = this.#nowNs();
      const { clientSendNs } = message.body.value;
      this.#sendTo(socket, { case: "clockReply", value: { clientSendNs, serverReceiveNs: nowNs, serverSendNs: nowNs } });
    }
  }

  #admit(): void {
    for (const socket of this.#pending.splice(0)) {
      if (this.isUp) socket.accept();
      else {
        this.#sockets.delete(socket);
        socket.end(1006, "");
      }
    }
  }

  #greet(socket: FakeSocket, { resume }: Hello): void {
    const missed = resume && resume.epoch === this.#epoch ? this.#sent.filter(({ offset }) => offset > resume.offset) : null;
    this.#live.add(socket);
    const value = {
      epoch: this.#epoch,
      recovered: missed !== null,
      resumeRequested: resume !== undefined,
      serverVersion: "fake",
      heartbeatMs: HEARTBEAT_MS,
      activeHeartbeatMs: ACTIVE_HEARTBEAT_MS,
      inputTtlMs: 250,
      settings: { touchSlopMm: TOUCH_SLOP_MM, longPressTimeoutMs: LONG_PRESS_MS, forceEnterN: FORCE_ENTER_N, forceExitN: FORCE_EXIT_N, forceMaxN: 3.5 },
      serverNowNs: this.#nowNs(),
      ...this.welcome,
    };
    this.#sendTo(socket, { case: "welcome", value }, missed ? resume!.offset : this.#offset);
    for (const { offset, timestampNs, events } of missed ?? []) {
      const edges = events.filter(({ type }) => {
        const name = EVENT_TYPES.name(type ?? 0);
        return name && !isStream(name) && !NEVER_REPLAYED.has(name);
      });
      if (edges.length) this.#sendTo(socket, { case: "batch", value: { timestampNs, sentNs: this.#nowNs(), events: edges } }, offset);
    }
  }

  #sendTo(socket: FakeSocket, body: ServerBody, offset = this.#offset): void {
    const data = toBinary(ServerMessageSchema, create(ServerMessageSchema, { offset, body }));
    if (this.#isSilent) this.#unsaid.push([socket, data]);
    else socket.deliver(data);
  }

  #nowNs(): bigint {
    return nanosecondsOf(this.clock.nowMs() + AHEAD_MS);
  }
}
