import { equals, fromBinary, fromJson, toBinary, type JsonValue } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import { ClientMessageSchema, ServerMessageSchema } from "../../src/gen/egotouch/v1/egotouch_pb.js";
import { encodeClientMessage, type ClientBody } from "../../src/wire/messages.js";
import { readMessages, readText, Replay, STREAMS } from "../support/vectors.js";

const lines = (name: string) => readText(name).split("\n").filter(Boolean);
const twins = (kind: string) => STREAMS.filter((name) => name !== "newer_server").map((name) => [name, `${name}_${kind}.bin`] as const);

test("all fifteen streams are there", () => {
  expect(STREAMS).toHaveLength(15);
});

describe.each(STREAMS)("%s", (name) => {
  test("the calls are those of the log", () => {
    const replay = new Replay();
    for (const message of readMessages(`${name}.bin`)) replay.receive(message);
    replay.end();
    expect(replay.log).toEqual(lines(`${name}.log`));
    expect(replay.errors).toEqual([]);
    expect(replay.session.pointers.events).toEqual([]);
  });

  test("binary and JSON hold equal messages", () => {
    const json = JSON.parse(readText(`${name}.json`)) as (JsonValue | null)[];
    const messages = readMessages(`${name}.bin`);
    expect(json).toHaveLength(messages.length);
    messages.forEach((data, i) => {
      if (data === null) return expect(json[i]).toBeNull();
      const fromWire = fromBinary(ServerMessageSchema, data, { readUnknownFields: false });
      const parsed = toBinary(ServerMessageSchema, fromJson(ServerMessageSchema, json[i]!, { ignoreUnknownFields: true })); // to 32-bit floats
      return expect(equals(ServerMessageSchema, fromWire, fromBinary(ServerMessageSchema, parsed))).toBe(true);
    });
  });
});

describe.each([...twins("truncated"), ...twins("invalid")])("%s: %s", (name, file) => {
  test("the last message is refused and nothing of it reaches the app", () => {
    const replay = new Replay();
    const messages = readMessages(file);
    for (const message of messages.slice(0, -1)) replay.receive(message);
    expect(replay.errors).toEqual([]);
    const before = [...replay.log];
    expect(before).toEqual(lines(`${name}.log`).slice(0, before.length));
    replay.receive(messages.at(-1)!);
    expect(replay.log).toEqual(before);
    expect(replay.errors).toMatchObject([{ kind: "error", error: { code: "protocol" } }]);
    expect(replay.session.state).toBe("disconnected");
  });
});

test("messages of a client are encoded as Python encodes them", () => {
  const json = JSON.parse(readText("client_messages.json")) as JsonValue[];
  readMessages("client_messages.bin").forEach((data, i) => {
    const { body } = fromJson(ClientMessageSchema, json[i]!);
    expect(encodeClientMessage(body as ClientBody)).toEqual(new Uint8Array(data!));
    expect(toBinary(ClientMessageSchema, fromBinary(ClientMessageSchema, data!))).toEqual(new Uint8Array(data!));
  });
});
