// The client and the real server: `egotouch simulate` in a process of its own.

import { mkdtempSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, test } from "vitest";
import WebSocket from "ws";
import { EgoTouchClient, GrammarVerifier, isStream, type TouchEvent } from "../../src/index.js";
import type { SocketConstructor } from "../../src/platform.js";
import { PlayedHand, PythonServer, until } from "../support/python_server.js";

/** A second try for a server that the machine left no time; both are reported. */
const RETRY = { retry: 1 };

/** The sockets that the client under test has opened, the newest last. */
let sockets: WebSocket[];
let server: PythonServer;
let client: EgoTouchClient;
let hand: PlayedHand;
let events: TouchEvent[];
let errors: unknown[];
let told: number;

class NotedSocket extends WebSocket {
  constructor(url: string, protocols: string) {
    super(url, protocols, { perMessageDeflate: false });
    sockets.push(this);
  }
}

function listen(url: string, options: object = {}): void {
  // Late edges come too, and none is too old: on a loaded machine every edge may be late.
  const everything = { subscribe: { lateEdges: true }, inputTtlMs: Infinity };
  client = new EgoTouchClient({ url, WebSocket: NotedSocket as unknown as SocketConstructor, debug: true, ...everything, ...options });
  client.onBatch((batch) => void events.push(...batch.events));
  client.onError((error) => void errors.push(error));
  hand = new PlayedHand(client);
}

/** Types of the edges since the last call, without long clicks: how long a press lasts is the machine's affair. */
const edges = () => events.slice(told).filter(({ type }) => !isStream(type) && type !== "long_click").map(({ type, local }) => (local ? `${type}*` : type));

async function hear(...types: string[]): Promise<void> {
  await until(() => edges().length >= types.length, () => `${types.join(" ")}, heard ${edges().join(" ")}`);
  expect(edges()).toEqual(types);
  told = events.length;
}

beforeEach(async () => {
  [sockets, events, errors, told] = [[], [], [], 0];
  server = new PythonServer();
  await server.start();
  listen(server.url);
  client.start();
  await until(() => client.state === "live");
});

afterEach(async () => {
  hand.end();
  client.stop();
  await server.kill();
  expect(errors).toEqual([]);
  const verifier = new GrammarVerifier();
  expect([...verifier.feed(events), ...verifier.close()].map(({ rule }) => rule)).toEqual([]);
});

test("a tap and a second finger are heard as they are played", RETRY, async () => {
  hand.play({});
  await hear("hover_enter");
  hand.play({ forceN: 1 });
  await hear("down");
  hand.play({ forceN: 1 }, { finger: "ring", xMm: 24 });
  await hear("hover_enter");
  hand.play({ forceN: 1 }, { finger: "ring", xMm: 24, forceN: 2.5 });
  await hear("down", "force_enter");
  expect(client.contacts).toBe(2);
  hand.play({}, { finger: "ring", xMm: 24 });
  await until(() => edges().filter((type) => type === "click").length === 2);
  told = events.length;
  hand.play({});
  await hear("hover_exit");
  const [index, ring] = ["index", "ring"].map((finger) => events.find((event) => event.type === "down" && event.finger === finger)!);
  expect(index).toMatchObject({ hand: "right", hostHand: "left", surface: "palm", local: false });
  expect(index!.yMm).toBeCloseTo(40, 0);
  expect(index!.forceN).toBeGreaterThan(0);
  expect(ring!.xMm).toBeCloseTo(24, 0);
  expect(index!.latencyMs).toBeGreaterThan(0);
});

test("a server that is killed in a touch cancels it here; a new one is heard again", RETRY, async () => {
  hand.play({});
  await hear("hover_enter");
  hand.play({ forceN: 1 });
  await hear("down");
  await server.kill();
  await hear("cancel*", "hover_exit*");
  expect(client.contacts).toBe(0);
  hand.play();
  await server.start();
  await until(() => client.state === "live");
  expect(client.welcome).toMatchObject({ resumeRequested: true, recovered: false });
  hand.play({});
  await hear("hover_enter");
  hand.play({ forceN: 1 });
  await hear("down");
  hand.play({});
  await hear("up", "click");
});

test("a server that stands still in a touch cancels it here, and goes on with the next touch", RETRY, async () => {
  hand.play({});
  await hear("hover_enter");
  hand.play({ forceN: 1 });
  await hear("down");
  server.signal("SIGSTOP");
  await hear("cancel*", "hover_exit*");
  expect(client.state).toBe("stale");
  hand.play();
  server.signal("SIGCONT");
  await until(() => client.state === "live");
  hand.play({});
  await until(() => edges().includes("hover_enter"));
  told = events.length;
  await until(() => client.pointers.some(({ type }) => type === "hover_move"));
  hand.play({ forceN: 1 });
  await until(() => edges().includes("down"));
});

test("a connection that is cut in a touch comes back and recovers; the touch goes on", RETRY, async () => {
  hand.end();
  const player = new EgoTouchClient({ url: server.url, WebSocket: WebSocket as unknown as SocketConstructor });
  player.start();
  await until(() => player.state === "live");
  hand = new PlayedHand(player);
  hand.play({});
  await hear("hover_enter");
  hand.play({ forceN: 1 });
  await hear("down");
  let recovered: boolean | null = null;
  client.onWelcome((welcome) => (recovered = welcome.recovered));
  sockets.at(-1)!.terminate();
  await until(() => recovered !== null);
  expect(recovered).toBe(true);
  hand.play({});
  await until(() => client.contacts === 0 && edges().length > 0);
  // Where the machine took more than 300 ms to connect, this client has ended the touch by itself.
  expect(edges()[0]).toBe(events.some(({ local }) => local) ? "cancel*" : "up");
  player.stop();
});

describe("a server with a token", () => {
  test("refuses a wrong one and takes the right one", async () => {
    const file = join(mkdtempSync(join(tmpdir(), "egotouch-")), "token");
    const guarded = new PythonServer(["simulate", "--no-browser", "--token-file", file]);
    await guarded.start();
    const wanted: string[] = [];
    const other = new EgoTouchClient({ url: guarded.url, token: "wrong", WebSocket: WebSocket as unknown as SocketConstructor });
    other.onAccessWanted((reason) => void wanted.push(reason));
    other.start();
    await until(() => wanted.length > 0);
    expect(other.state).toBe("disconnected");
    other.start({ token: readFileSync(file, "utf8").trim() });
    await until(() => other.state === "live");
    expect(wanted).toHaveLength(1);
    other.stop();
    await guarded.kill();
  });
});
