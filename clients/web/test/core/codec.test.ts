// The table-driven codec and protobuf-es's own classes: the same bytes for the same messages, the same messages from the same bytes.

import { create, equals, fromBinary, toBinary } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import { FIELDS } from "../../src/gen/fields.js";
import { ClientMessageSchema, ServerMessageSchema } from "../../src/gen/egotouch/v1/egotouch_pb.js";
import { decode, encode, type MessageName } from "../../src/wire/codec.js";
import { randomNumbers } from "../support/random.js";
import { readMessages, STREAMS } from "../support/vectors.js";

const SCHEMAS = { ServerMessage: ServerMessageSchema, ClientMessage: ClientMessageSchema };
const random = randomNumbers(3);
const below = (limit: number) => Math.floor(random() * limit);

/** A value of a type, its extremes among them. */
function value(type: string, depth: number): unknown {
  const wide = () => [0n, 1n, 2n ** 53n + 1n, 2n ** 63n - 1n][below(4)]!;
  switch (type) {
    case "bool":
      return random() < 0.5;
    case "bytes":
      return Uint8Array.from({ length: below(4) }, () => below(256));
    case "double":
      return [0, -0, 0.1, 1e300][below(4)];
    case "float":
      return Math.fround([0, -0, 0.1, -1e20][below(4)]!);
    case "enum":
    case "uint32":
      return [0, 1, 5, 2 ** 31 - 1][below(4)];
    case "string":
      return ["", "a", "Grüße, 触"][below(3)];
    case "uint64":
    case "fixed64":
      return wide();
    case "sint64":
    case "sfixed64":
      return random() < 0.5 ? wide() : -wide();
    default:
      return content(type as MessageName, depth + 1);
  }
}

/** Any message, up to some depth. */
function content(name: MessageName, depth: number): Record<string, unknown> {
  const made: Record<string, unknown> = {};
  for (const [, key, type, often] of FIELDS[name] as readonly (readonly [number, string, string, string])[]) {
    if (random() < 0.3 || (depth > 3 && type in FIELDS)) continue;
    if (often === "*") made[key] = Array.from({ length: below(3) }, () => value(type, depth));
    else if (often === "" || often === "?") made[key] = value(type, depth);
    else made[often] = { case: key, value: value(type, depth) };
  }
  return made;
}

describe.each(["ServerMessage", "ClientMessage"] as const)("a %s", (name) => {
  const schema = SCHEMAS[name] as typeof ServerMessageSchema;

  test("is written and read alike, whatever is in it", () => {
    for (let i = 0; i < 1500; i += 1) {
      const made = content(name, 0);
      const bytes = encode(name, made);
      expect(bytes).toEqual(toBinary(schema, create(schema, made as never)));
      expect(decode(name, bytes)).toEqual(plain(fromBinary(schema, bytes)));
    }
  });

  test("that is cut off or has other bytes in it is an error, or read as one that can be written again", () => {
    let refused = 0;
    for (let i = 0; i < 1500; i += 1) {
      const bytes = encode(name, content(name, 0));
      const spoiled = random() < 0.5 ? bytes.subarray(0, below(bytes.length)) : bytes.map((byte) => (random() < 0.1 ? below(256) : byte));
      try {
        const read = decode(name, spoiled);
        expect(decode(name, encode(name, read))).toEqual(read);
      } catch (error) {
        expect(error).toBeInstanceOf(Error);
        refused += 1;
      }
    }
    expect(refused).toBeGreaterThan(100);
  });
});

/** A message of protobuf-es as the plain object that it is. */
const plain = (message: object): unknown => JSON.parse(JSON.stringify(message, tagged), untagged);
const tagged = (_: string, item: unknown) => (typeof item === "bigint" ? `${item}n` : item instanceof Uint8Array ? { bytes: [...item] } : Object.is(item, -0) ? "-0" : item);
function untagged(_: string, item: unknown): unknown {
  if (typeof item === "string" && /^-?\d+n$/.test(item)) return BigInt(item.slice(0, -1));
  if (item === "-0") return -0;
  if (typeof item === "object" && item !== null && "bytes" in item) return Uint8Array.from(item.bytes as number[]);
  return item;
}

test("all messages of the vectors are read as protobuf-es reads them", () => {
  for (const data of STREAMS.flatMap((name) => readMessages(`${name}.bin`))) {
    if (!data) continue;
    const read = decode("ServerMessage", data);
    expect(equals(ServerMessageSchema, read as never, fromBinary(ServerMessageSchema, data, { readUnknownFields: false }))).toBe(true);
  }
});

test("a field of another wire type is passed over, a message nested without end refused", () => {
  expect(decode("ServerMessage", new Uint8Array([10, 1, 7]))).toMatchObject({ offset: 0n });
  let nested = new Uint8Array();
  for (let i = 0; i < 200; i += 1) nested = new Uint8Array([0xc2, 1, ...varint(nested.length), ...nested]);
  expect(() => decode("TouchEvent", nested)).toThrow("too deep");
});

function varint(value: number): number[] {
  return value < 128 ? [value] : [(value & 127) | 128, ...varint(value >>> 7)];
}
