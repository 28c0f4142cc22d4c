// Whatever bytes come, a session takes them or ends the link, and an app hears only what keeps the grammar.

import { expect, test } from "vitest";
import { GrammarVerifier } from "../../src/index.js";
import { randomNumbers } from "../support/random.js";
import { readMessages, Replay, STREAMS } from "../support/vectors.js";

test("3000 messages with other bytes in them break nothing", () => {
  const random = randomNumbers(7);
  const pick = <T>(list: readonly T[]): T => list[Math.floor(random() * list.length)]!;
  const good = STREAMS.flatMap((name) => readMessages(`${name}.bin`)).filter((data) => data !== null);
  const welcome = readMessages("tap.bin")[0]!;
  let refused = 0;
  let replay = new Replay();
  replay.receive(welcome);
  for (let i = 0; i < 3000; i += 1) {
    const data = Uint8Array.from(pick(good));
    for (let n = 0; n < 1 + 3 * random(); n += 1) data[Math.floor(random() * data.length)] = Math.floor(256 * random());
    replay.receive(data);
    if (replay.session.state !== "disconnected") continue;
    refused += 1;
    replay = new Replay();
    replay.receive(welcome);
  }
  expect(refused).toBeGreaterThan(300);
  expect(refused).toBeLessThan(2700);
});

test.each(STREAMS)("%s cut off anywhere leaves nothing open", (name) => {
  const messages = readMessages(`${name}.bin`);
  for (let end = 1; end <= messages.length; end += 3) {
    const replay = new Replay();
    for (const message of messages.slice(0, end)) replay.receive(message);
    replay.end();
    expect(replay.session.pointers.events).toEqual([]);
    const verifier = new GrammarVerifier();
    expect(verifier.feed(replay.events).map(({ rule }) => rule)).toEqual([]);
    expect(verifier.close()).toEqual([]);
  }
});
