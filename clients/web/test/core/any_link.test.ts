// Whatever fingers and links do, an app hears a stream that keeps the grammar, and nothing sticks.

import { expect, test } from "vitest";
import type { Finger } from "../../src/index.js";
import { FakeFinger, FakeServer } from "../../src/testing/index.js";
import { connected } from "../support/heard.js";
import { randomNumbers } from "../support/random.js";

const FINGERS: readonly Finger[] = ["thumb", "index", "middle", "ring", "pinky"];
const RUNS = 150;
const STEPS = 60;

/** One thing that may happen to a finger. */
function moveSome(finger: FakeFinger, isDown: Map<FakeFinger, boolean>, random: () => number): void {
  const [x, y] = [random() * 20, 20 + random() * 20];
  if (isDown.get(finger)) {
    if (random() < 0.6) return void finger.move(x, y, 3 * random());
    isDown.set(finger, false);
    if (random() < 0.8) finger.up();
    else finger.lose();
    return;
  }
  if (random() < 0.5) return void finger.hover(x, y);
  finger.hover(x, y).down(3 * random());
  isDown.set(finger, true);
}

/** One thing that may happen to the link. */
function shake(server: FakeServer, random: () => number): void {
  const what = random();
  if (what < 0.15) server.drop([1006, 4001, 4008][Math.floor(random() * 3)]!);
  else if (what < 0.2) server.restart();
  else if (what < 0.35) server.isSilent = !server.isSilent;
  else if (what < 0.45) server.isUp = !server.isUp;
  else if (what < 0.5) server.sendBytes(Uint8Array.from({ length: 20 }, () => 256 * random()));
  else if (what < 0.6) server.clock.jump(1000 * random());
  else server.advance(600 * random());
}

test.each(Array.from({ length: RUNS }, (_, i) => i))("run %i", (seed) => {
  const random = randomNumbers(seed);
  const { server, client, events, errors } = connected({ random });
  const isDown = new Map<FakeFinger, boolean>();
  let fingers = FINGERS.slice(0, 2).map((finger) => server.finger({ finger }));
  for (let step = 0; step < STEPS; step += 1) {
    if (random() < 0.75) moveSome(fingers[Math.floor(random() * fingers.length)]!, isDown, random);
    else shake(server, random);
    if (random() < 0.03) {
      fingers.forEach((finger) => finger.lose("hand_swapped"));
      fingers = FINGERS.slice(0, 2).map((finger) => server.finger({ finger }));
      isDown.clear();
    }
  }
  server.isSilent = true;
  server.advance(400);
  expect(client.contacts).toBe(0);
  client.stop();
  expect(errors.filter(({ error }) => (error as { code?: string }).code !== "protocol").map(({ error }) => String(error))).toEqual([]);
  expect(client.pointers).toEqual([]);
  const ends = events.filter(({ type }) => type === "up" || type === "cancel").length;
  expect(ends).toBe(events.filter(({ type }) => type === "down").length);
});
