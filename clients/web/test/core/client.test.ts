import { describe, expect, test, vi } from "vitest";
import { EgoTouchClient, type TouchEvent } from "../../src/index.js";
import { FakeServer } from "../../src/testing/index.js";
import { connected } from "../support/heard.js";

describe("listeners", () => {
  test("a tap is heard by the listeners of its parts, in order, and nothing else happens", () => {
    const { server, client, errors } = connected();
    const calls: string[] = [];
    const note = (name: string) => (event: TouchEvent) => void calls.push(`${name} ${event.finger} ${event.surface}`);
    client.onHoverEnter(note("enter"));
    client.onTouchDown(note("down"));
    client.onTouchMove(note("move"));
    client.onTouchUp(note("up"));
    client.onClick(note("click"));
    client.onDoubleClick(note("double"));
    client.onLongClick(note("long"));
    client.onTouchCancel(note("cancel"));
    client.onHoverExit(note("exit"));
    server.finger({ finger: "middle", surface: "inner_forearm" }).tap(0, -80).leave();
    expect(calls).toEqual(["enter", "down", "move", "up", "click", "exit"].map((name) => `${name} middle inner_forearm`));
    expect(errors).toEqual([]);
  });

  test("a filter lets only its finger, hand and surface through", () => {
    const { server, client } = connected();
    const clicks: string[] = [];
    client.onClick((event) => void clicks.push(event.finger), { finger: ["index", "thumb"], hand: "right", surface: "palm" });
    for (const settings of [{}, { finger: "ring" }, { hand: "left" }, { surface: "back_of_hand" }, { finger: "thumb" }] as const) {
      server.finger(settings).tap(0, 40).leave();
    }
    expect(clicks).toEqual(["index", "thumb"]);
  });

  test("names that do not exist and lists that are empty are refused", () => {
    const client = new EgoTouchClient({ url: "ws://nowhere/" });
    expect(() => client.onClick(() => {}, { finger: "toe" as never })).toThrow("there is no finger \"toe\". Give one of thumb, index");
    expect(() => client.onClick(() => {}, { surface: [] })).toThrow("empty");
    expect(() => client.onClick("click" as never)).toThrow("cannot be called");
    expect(() => client.addListener({ onclick() {} } as never)).toThrow("Name it onClick");
    expect(() => client.events({ types: ["tap" as never] })).toThrow("there is no event \"tap\"");
  });

  test("a removed listener hears nothing more, also when it removes itself", () => {
    const { server, client } = connected();
    let heard = 0;
    const subscription = client.onTouchDown(() => {
      heard += 1;
      subscription.remove();
      subscription.remove();
    });
    const finger = server.finger();
    finger.tap(0, 40).tap(0, 40);
    expect([heard, subscription.isActive]).toEqual([1, false]);
  });

  test("a listener that throws harms nobody and is told to onError", () => {
    const printed = vi.spyOn(console, "error").mockImplementation(() => {});
    const { server, client, errors } = connected();
    const heard: string[] = [];
    client.onClick(() => {
      throw new Error("my mistake");
    });
    client.onClick((event) => void heard.push(event.type));
    client.onError(() => {
      throw new Error("in onError as well");
    });
    server.finger().tap(0, 40);
    expect(heard).toEqual(["click"]);
    expect(errors).toMatchObject([{ listener: "onClick", error: { message: "my mistake" }, event: { type: "click" } }]);
    expect(client.stats.listenerErrors).toBe(2);
    expect(printed).toHaveBeenCalledExactlyOnceWith("onError has thrown", expect.any(Error));
    printed.mockRestore();
  });

  test("only a long click that returns true consumes the click, of its contact, for everyone", () => {
    const { server, client } = connected();
    const clicks: number[] = [];
    let consume = true;
    client.onClick((event) => void clicks.push(event.contactId));
    const seen: string[] = [];
    client.addListener({ onLongClick: () => consume, onClick: (event) => void seen.push(event.type) });
    const finger = server.finger().press(0, 40).tap(0, 40);
    consume = false;
    finger.press(0, 40);
    expect(clicks).toEqual([2, 3]);
    expect(seen).toEqual(["click", "click"]);
  });

  test("the raw listener hears touches before all others and is replaced by the next", () => {
    const { server, client } = connected();
    const calls: string[] = [];
    client.onTouchDown(() => void calls.push("onTouchDown"));
    client.setOnTouchListener(() => void calls.push("first"));
    client.setOnTouchListener((event) => void calls.push(event.type));
    server.finger().tap(0, 40);
    client.setOnTouchListener(null);
    server.finger({ finger: "ring" }).tap(0, 40);
    expect(calls).toEqual(["down", "onTouchDown", "move", "up", "onTouchDown"]);
  });

  test("a force press is told from its threshold on", () => {
    const { server, client } = connected();
    const forces: string[] = [];
    client.onForce((event) => void forces.push(`${event.type} ${event.forceN.toFixed(1)}`));
    server.finger().hover(0, 40).down(1).move(0, 40, 2).move(0, 40, 1).move(0, 40, 3).up();
    expect(forces).toEqual(["force_enter 2.0", "force_exit 1.0", "force_enter 3.0", "force_exit 0.0"]);
  });

  test("a listener that stops the client is the last to hear something", () => {
    const { server, client, types, errors } = connected();
    client.onTouchDown(() => client.stop());
    server.finger().hover(0, 40).down();
    expect(types()).toEqual(["hover_enter", "down", "cancel*", "hover_exit*"]);
    expect([client.state, errors]).toEqual(["disconnected", []]);
  });
});

describe("the async iterator", () => {
  test("gives events until its signal aborts", async () => {
    const { server, client } = connected();
    const end = new AbortController();
    const events = client.events({ types: ["down", "click"], signal: end.signal });
    server.finger().tap(0, 40);
    end.abort();
    server.finger({ finger: "ring" }).tap(0, 40);
    const heard: string[] = [];
    for await (const event of events) heard.push(event.type);
    expect(heard).toEqual(["down", "click"]);
  });

  test("merges moves of a slow reader and never an edge", async () => {
    const { server, client } = connected();
    const events = client.events();
    server.finger().drag([0, 20], [0, 70], { frames: 30 }).leave();
    client.stop();
    const heard: TouchEvent[] = [];
    for await (const event of events) heard.push(event);
    const types = heard.map((event) => event.type);
    expect(types.filter((type) => type !== "move" && type !== "drag")).toEqual(["hover_enter", "down", "drag_start", "drag_end", "up", "hover_exit"]);
    expect(types.length).toBeLessThan(12);
    const merged = heard.find((event) => event.type === "drag")!;
    expect(merged.coalesced).toHaveLength(8);
    const places = [...merged.coalesced, merged].map((event) => event.yMm);
    expect(places).toEqual([...places].sort((a, b) => a - b));
  });

  test("a reader that waits gets each event at once; leaving the loop ends it", async () => {
    const { server, client } = connected();
    const heard: string[] = [];
    const done = (async () => {
      for await (const event of client.events()) {
        heard.push(event.type);
        if (event.type === "click") break;
      }
    })();
    server.finger().tap(0, 40).leave();
    await done;
    expect(heard.at(-1)).toBe("click");
  });

  test("a reader that never reads is told, and costs no memory for ever", async () => {
    const { server, client } = connected();
    const events = client.events();
    const finger = server.finger();
    for (let i = 0; i < 400; i += 1) finger.tap(0, 40);
    const drain = (async () => {
      for await (const event of events) void event;
    })();
    await expect(drain).rejects.toMatchObject({ code: "too_slow" });
  });
});

describe("access", () => {
  test("a pairing code is exchanged for a token that the next Hello carries", () => {
    const server = new FakeServer();
    server.welcome = { token: "secret" };
    const tokens: string[] = [];
    const client = new EgoTouchClient(server.options({ pairingCode: "123456", token: "old", name: "app", version: "2" }));
    client.onToken((token) => void tokens.push(token));
    server.connect(client);
    server.drop();
    server.advance(1000);
    expect(tokens).toEqual(["secret", "secret"]);
    expect(server.hellos.map(({ client: name, version, token, pairingCode }) => ({ name, version, token, pairingCode }))).toEqual([
      { name: "app", version: "2", token: "", pairingCode: "123456" },
      { name: "app", version: "2", token: "secret", pairingCode: "" },
    ]);
  });

  test("a server that wants a token is asked again only when the app has one", () => {
    const { server, client, states } = connected({ token: "wrong" });
    const wanted: string[] = [];
    client.onAccessWanted((reason) => void wanted.push(reason));
    server.drop(4401, "token or pairing code are missing");
    server.advance(20_000);
    expect(wanted).toEqual(["This server wants a pairing code or a token. Both are shown where it was started."]);
    expect([states.at(-1), server.connections]).toEqual(["disconnected", 0]);
    client.start({ token: "right" });
    server.advance(10);
    expect([client.state, server.hellos.at(-1)!.token]).toEqual(["live", "right"]);
  });
});

test("status is asked for when somebody listens, and changes of tracking are told once", () => {
  const { server, client } = connected();
  const tracking: string[] = [];
  client.onTrackingChanged(({ gate, handsInView }) => void tracking.push(`${gate} ${handsInView}`));
  expect(server.messages.at(-1)!.body).toMatchObject({ case: "subscribe", value: { status: true } });
  for (const handsInView of [0, 0, 2]) server.send({ case: "status", value: { gate: handsInView ? 1 : 2, handsInView } });
  expect(tracking).toEqual(["no_hands 0", "open 2"]);
});

test("every event carries its latency by the server's clock", () => {
  const { server, events, client } = connected();
  server.finger().tap(0, 40);
  server.publish([{ type: 2, pointerId: 1, contactId: 1, timestampNs: BigInt(Math.round((server.clock.nowMs() + 7_000_000 - 20) * 1e6)), hand: 2, finger: 2, surface: 1 }]);
  expect(events.at(-1)!.latencyMs).toBeCloseTo(20, 3);
  expect(client.clockUncertaintyMs).toBeCloseTo(0, 3);
  expect(client.serverTimeMs).toBeCloseTo(server.clock.nowMs() + 7_000_000, 3);
});

describe("an address", () => {
  test.each(["", "localhost:8765", "http://host/", "ws://"])("such as %j is refused at once", (url) => {
    expect(() => new EgoTouchClient({ url })).toThrow("is no address of a server. Give one such as ws://localhost:8765/");
  });

  test("that the browser itself refuses is tried again, with a hint", () => {
    const server = new FakeServer();
    class Refusing {
      constructor() {
        throw new DOMException("insecure", "SecurityError");
      }
    }
    const client = new EgoTouchClient(server.options({ WebSocket: Refusing }));
    client.start();
    expect([client.state, client.detail]).toEqual(["disconnected", "No server answers at this address. Is `egotouch serve` running? Trying again …"]);
    client.stop();
  });

  test("where there is no WebSocket at all is told to the caller, and starting again works", () => {
    const client = new EgoTouchClient({ url: "ws://localhost:1/", WebSocket: undefined as never });
    const { WebSocket } = globalThis;
    vi.stubGlobal("WebSocket", undefined);
    expect(() => client.start()).toThrow("Pass the option WebSocket");
    expect(() => client.start()).toThrow("Pass the option WebSocket");
    client.stop();
    vi.stubGlobal("WebSocket", WebSocket);
  });
});
