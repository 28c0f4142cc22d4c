// What becomes of touches when the link does what links do.

import { describe, expect, test } from "vitest";
import { SILENCE_MS } from "../../src/core/session.js";
import { EgoTouchClient } from "../../src/index.js";
import { FakeServer } from "../../src/testing/index.js";
import { connected, listenTo } from "../support/heard.js";
import { readMessages, Replay } from "../support/vectors.js";

const PRESS = 2;

describe("silence", () => {
  test("of 300 ms while a finger is down cancels it, ends its drag and press, and clicks nothing", () => {
    const { server, client, types, states, errors } = connected();
    server.finger().hover(0, 20).down(PRESS).move(0, 40);
    types();
    server.isSilent = true;
    server.advance(SILENCE_MS - 60);
    expect(types()).toEqual([]);
    server.advance(120);
    expect(types()).toEqual(["drag_end*", "force_exit*", "cancel*", "hover_exit*"]);
    expect([states.at(-1), client.contacts, client.stats.cancelledHere, errors]).toEqual(["stale", 0, 1, []]);
  });

  test("that ends finds nothing of the old contact again; the next touch is heard whole", () => {
    const { server, client, types, states, errors } = connected();
    const finger = server.finger().hover(0, 20).down();
    server.isSilent = true;
    server.advance(400);
    types();
    finger.move();
    server.isSilent = false;
    finger.move().up();
    expect(types()).toEqual([]);
    finger.tap(5, 30);
    expect(types()).toEqual(["hover_enter", "down", "move", "up", "click"]);
    expect([states.at(-1), client.stats.reconnects, errors]).toEqual(["live", 0, []]);
  });

  test("while only hovering changes nothing for 2.5 heartbeats, then the client connects anew", () => {
    const { server, types, states } = connected();
    server.finger().hover(0, 20);
    server.isSilent = true;
    server.advance(4900);
    expect([types(), server.hellos.length]).toEqual([["hover_enter"], 1]);
    server.advance(400);
    expect(server.hellos).toHaveLength(2);
    server.isSilent = false;
    expect(states).toEqual(["connecting", "live", "disconnected", "connecting", "live"]);
  });

  test("of a page that slept is none while messages wait to be read", () => {
    const { server, types } = connected();
    const finger = server.finger().hover(0, 20).down();
    types();
    server.clock.jump(2000);
    finger.move();
    expect(types()).toEqual(["move", "long_click"]);
    server.isSilent = true;
    server.clock.jump(2000);
    expect(types()).toEqual([]);
    server.clock.jump(60);
    expect(types()).toEqual(["cancel*", "hover_exit*"]);
  });

  test("of a server that never says Welcome ends in another try", () => {
    const server = new FakeServer();
    server.isSilent = true;
    const client = new EgoTouchClient(server.options());
    const { states } = listenTo(client, server);
    server.connect(client);
    server.advance(7900);
    expect(states).toEqual(["connecting"]);
    server.isSilent = false;
    server.advance(400);
    expect(states.at(-1)).toBe("live");
  });
});

describe("a lost connection", () => {
  test("that is back within 300 ms resumes the touch", () => {
    const { server, types, errors } = connected({ random: () => 0.4 });
    const finger = server.finger().hover(0, 20).down(PRESS).move(0, 40);
    types();
    server.drop();
    server.advance(250);
    const [, { resume }] = server.hellos as [unknown, { resume: unknown }];
    expect(resume).toMatchObject({ epoch: 1n, held: [{ pointerId: 1, contactId: 1, dragging: true, pressing: true }] });
    expect(types()).toEqual([]);
    finger.move(0, 45).up();
    expect(types()).toEqual(["move", "drag", "drag_end", "force_exit", "up"]);
    expect(errors).toEqual([]);
  });

  test("replays the edges that were missed, without clicks", () => {
    const { server, types, errors } = connected({ random: () => 0 });
    const finger = server.finger().hover(0, 20).down();
    server.isUp = false;
    server.drop();
    finger.move().up();
    server.isUp = true;
    server.advance(200);
    expect(types()).toEqual(["hover_enter", "down", "up"]);
    finger.tap(0, 20);
    expect(types()).toEqual(["hover_move", "down", "move", "up", "click"]);
    expect(errors).toEqual([]);
  });

  test("that stays away for more than 300 ms cancels, once", () => {
    const { server, types, states, errors } = connected({ random: () => 1 });
    server.finger().hover(0, 20).down();
    types();
    server.isUp = false;
    server.drop();
    server.advance(200);
    expect(types()).toEqual([]);
    server.advance(5000);
    expect(types()).toEqual(["cancel*", "hover_exit*"]);
    server.isUp = true;
    server.advance(6000);
    expect([types(), states.at(-1), errors]).toEqual([[], "live", []]);
    expect(server.hellos.at(-1)!.resume).toMatchObject({ epoch: 1n, held: [] });
  });

  test("to a server that started anew cancels what is open and begins again", () => {
    const { server, types, errors } = connected({ random: () => 0 });
    server.finger().hover(0, 20).down();
    types();
    server.restart();
    server.advance(100);
    expect(types()).toEqual(["cancel*", "hover_exit*"]);
    server.finger().tap(0, 20);
    expect(types()).toEqual(["hover_enter", "down", "move", "up", "click"]);
    expect(errors).toEqual([]);
  });

  test.each([4400, 4403, 4405, 4408, 4409, 4421, 4422, 4429, 4499, 1009, 1002])("with the code %i is not tried again, and cancels at once", (code) => {
    const { server, client, types } = connected();
    server.finger().hover(0, 20).down();
    types();
    server.drop(code);
    expect(types()).toEqual(["cancel*", "hover_exit*"]);
    server.advance(30_000);
    expect([server.hellos.length, client.state]).toEqual([1, "disconnected"]);
    expect(client.detail).toMatch(/\.$/);
  });

  test.each([1001, 1006, 1011, 4001, 4008, 4011])("with the code %i is tried again", (code) => {
    const { server, client } = connected();
    server.drop(code);
    server.advance(500);
    expect([server.hellos.length, client.state]).toEqual([2, "live"]);
  });

  test("is tried again after pauses under a ceiling that doubles from 250 ms to 5 s", () => {
    const server = new FakeServer();
    server.isUp = false;
    const tries: number[] = [];
    const client = new EgoTouchClient(server.options({ random: () => 0.999 }));
    client.onState(({ state }) => void (state === "connecting" && tries.push(server.clock.nowMs())));
    server.connect(client);
    server.advance(40_000);
    const pauses = tries.slice(1).map((at, i) => at - tries[i]!);
    const ceilings = [250, 500, 1000, 2000, 4000, 5000, 5000];
    pauses.slice(0, ceilings.length).forEach((pause, i) => {
      expect(pause).toBeGreaterThan(ceilings[i]! - 60);
      expect(pause).toBeLessThan(ceilings[i]! + 120);
    });
    client.stop();
    server.advance(20_000);
    expect(tries).toHaveLength(pauses.length + 1);
  });
});

describe("what is no message", () => {
  test.each([[[]], [[255]], [[26, 5, 1]], [[26, 3, 1, 2]]])("%j ends the link, which comes back; nothing reaches the app", (bytes) => {
    const { server, client, events, errors } = connected({ random: () => 0 });
    server.sendBytes(new Uint8Array(bytes));
    server.advance(100);
    if (bytes.length === 0) expect(errors).toEqual([]); // an empty message is one of a kind that is not known yet
    else expect(errors).toMatchObject([{ error: { code: "protocol" } }]);
    expect([client.state, events]).toEqual(["live", []]);
  });

  test("a batch before the Welcome is refused", () => {
    const replay = new Replay();
    replay.receive(readMessages("tap.bin")[1]!);
    expect(replay.errors).toMatchObject([{ error: { message: "a batch came before the Welcome" } }]);
    expect([replay.log, replay.session.state]).toEqual([[], "disconnected"]);
  });
});

describe("late input", () => {
  /** Publish the next frames as if they had been under way for that long. */
  function delayed(server: FakeServer, ms: number, play: () => void): void {
    const publish = server.publish.bind(server);
    server.send = ((send) => (body) => {
      if (body.case === "batch") body.value.sentNs = body.value.sentNs! - BigInt(ms) * 1_000_000n;
      send(body);
    })(server.send.bind(server));
    play();
    server.publish = publish;
  }

  test("a tap that was under way for a second does nothing", () => {
    const { server, client, types, errors } = connected();
    const finger = server.finger().hover(0, 20);
    types();
    delayed(server, 1000, () => finger.down().move().up());
    expect(types()).toEqual([]);
    expect([client.stats.dropped, errors]).toEqual([4, []]);
  });

  test("a late lift of a touch that was heard in time cancels it and does not click", () => {
    const { server, types, errors } = connected();
    const finger = server.finger().hover(0, 20).down(PRESS);
    types();
    delayed(server, 1000, () => finger.up());
    expect(types()).toEqual(["force_exit*", "cancel*"]);
    expect(errors).toEqual([]);
  });

  test("what came within the limit is in time, and without a limit everything is", () => {
    for (const [ms, inputTtlMs] of [[200, undefined], [100_000, Infinity]] as const) {
      const { server, types } = connected(inputTtlMs ? { inputTtlMs } : {});
      const finger = server.finger();
      delayed(server, ms, () => finger.tap(0, 20));
      expect(types()).toEqual(["hover_enter", "down", "move", "up", "click"]);
    }
  });

  test("late events of the server reach onLate only", () => {
    const { server, client, events } = connected({ subscribe: { lateEdges: true } });
    const acted: string[] = [];
    const late: string[] = [];
    client.onTouchDown((event) => void acted.push(event.type));
    client.onLate((event) => void late.push(event.type));
    const down = { pointerId: 9, hand: 2, finger: 2, surface: 1 };
    server.send({ case: "batch", value: { late: true, events: [{ ...down, type: 1 }, { ...down, type: 4, contactId: 1, downTimeNs: 0n, timestampNs: 0n }] } });
    expect([acted, late, events.every((event) => event.late)]).toEqual([[], ["hover_enter", "down"], true]);
  });
});

test("eight clock probes at the start, then one a second", () => {
  const { server } = connected();
  const probes = () => server.messages.filter(({ body }) => body.case === "clockRequest").length;
  server.advance(1000);
  expect(probes()).toBe(8);
  server.advance(10_000);
  expect(probes()).toBeGreaterThan(15);
  expect(probes()).toBeLessThan(20);
});
