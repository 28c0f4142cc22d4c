// Protobuf's binary form by the table of fields, on the reader and writer of protobuf-es: its own generated classes carry descriptors and
// reflection, 20 kB of gzip that a page of touches does not need. Tests hold the two to each other.

import { BinaryReader, BinaryWriter, WireType } from "@bufbuild/protobuf/wire";
import { FIELDS } from "../gen/fields.js";

export type MessageName = keyof typeof FIELDS;
type Scalar = "bool" | "bytes" | "double" | "enum" | "fixed64" | "float" | "sfixed64" | "sint64" | "string" | "uint32" | "uint64";
type Field = readonly [number: number, name: string, type: Scalar | MessageName, often: string];
type Content = Record<string, unknown>;
interface Choice {
  readonly case: string | undefined;
  readonly value?: unknown;
}

const OPTIONAL = "?";
const REPEATED = "*";
/** As protobuf's own libraries: what is nested deeper is no message of ours. */
const MOST_NESTED = 100;

const { Varint, Bit64, Bit32, LengthDelimited } = WireType;
const WIRE_TYPES: Readonly<Record<Scalar, WireType>> = {
  bool: Varint, bytes: LengthDelimited, double: Bit64, enum: Varint, fixed64: Bit64, float: Bit32, sfixed64: Bit64, sint64: Varint,
  string: LengthDelimited, uint32: Varint, uint64: Varint,
};
const ZEROS: Readonly<Record<Scalar, () => unknown>> = {
  bool: () => false, bytes: () => new Uint8Array(), double: () => 0, enum: () => 0, fixed64: () => 0n, float: () => 0, sfixed64: () => 0n,
  sint64: () => 0n, string: () => "", uint32: () => 0, uint64: () => 0n,
};
const TABLES = new Map(Object.entries(FIELDS).map(([name, fields]) => [name, new Map((fields as readonly Field[]).map((field) => [field[0], field]))]));

const isMessage = (type: Scalar | MessageName): type is MessageName => type in FIELDS;
const isInOneof = (often: string) => often !== "" && often !== OPTIONAL && often !== REPEATED;
const wireTypeOf = (type: Scalar | MessageName) => (isMessage(type) ? LengthDelimited : WIRE_TYPES[type]);

/** The message in `data`; fields of a newer schema are passed over. Throws for bytes that are none. */
export function decode(name: MessageName, data: Uint8Array): Content {
  return read(name, new BinaryReader(data), data.length, 0);
}

/** The bytes of a message; fields that are missing have their default value. */
export function encode(name: MessageName, content: Content): Uint8Array<ArrayBuffer> {
  return write(name, content, new BinaryWriter()).finish();
}

function read(name: MessageName, reader: BinaryReader, end: number, depth: number): Content {
  if (depth > MOST_NESTED) throw new RangeError("messages are nested too deep");
  const content = empty(name);
  while (reader.pos < end) {
    const [number, wireType] = reader.tag();
    const field = TABLES.get(name)?.get(number);
    if (!field) {
      reader.skip(wireType, number);
      continue;
    }
    const [, key, type, often] = field;
    const isPacked = often === REPEATED && wireType === LengthDelimited && wireTypeOf(type) !== LengthDelimited;
    if (isPacked) readPacked(reader, type as Scalar, content[key] as unknown[]);
    else if (wireType !== wireTypeOf(type)) reader.skip(wireType, number);
    else store(content, field, isMessage(type) ? readMessage(type, reader, depth) : readScalar(reader, type));
  }
  if (reader.pos > end) throw new RangeError(`a ${name} is longer than it says`);
  return content;
}

function readMessage(name: MessageName, reader: BinaryReader, depth: number): Content {
  const length = reader.uint32();
  const end = reader.pos + length;
  if (end > reader.len) throw new RangeError(`a ${name} is cut off`);
  return read(name, reader, end, depth + 1);
}

function readPacked(reader: BinaryReader, type: Scalar, list: unknown[]): void {
  const length = reader.uint32();
  const end = reader.pos + length;
  if (end > reader.len) throw new RangeError("a list is cut off");
  while (reader.pos < end) list.push(readScalar(reader, type));
}

const readScalar = (reader: BinaryReader, type: Scalar): unknown => (type === "enum" ? reader.int32() : reader[type]());

function store(content: Content, [, key, , often]: Field, value: unknown): void {
  if (often === REPEATED) (content[key] as unknown[]).push(value);
  else if (isInOneof(often)) content[often] = { case: key, value };
  else content[key] = value;
}

function empty(name: MessageName): Content {
  const content: Content = { $typeName: `egotouch.v1.${name}` };
  for (const [, key, type, often] of FIELDS[name] as readonly Field[]) {
    if (often === REPEATED) content[key] = [];
    else if (isInOneof(often)) content[often] = { case: undefined };
    else if (often !== OPTIONAL && !isMessage(type)) content[key] = ZEROS[type]();
  }
  return content;
}

function write(name: MessageName, content: Content, writer: BinaryWriter): BinaryWriter {
  for (const [number, key, type, often] of FIELDS[name] as readonly Field[]) {
    const choice = isInOneof(often) ? (content[often] as Choice | undefined) : undefined;
    const value = choice ? (choice.case === key ? choice.value : undefined) : content[key];
    if (value === undefined || value === null) continue;
    if (often === REPEATED) writeList(writer, number, type, value as readonly unknown[]);
    else if (isMessage(type)) writeMessage(writer, number, type, value as Content);
    else if (choice || often === OPTIONAL || !isZero(value)) writeScalar(writer.tag(number, WIRE_TYPES[type]), type, value);
  }
  return writer;
}

function writeList(writer: BinaryWriter, number: number, type: Scalar | MessageName, values: readonly unknown[]): void {
  if (!values.length) return;
  if (isMessage(type)) for (const value of values) writeMessage(writer, number, type, value as Content);
  else if (WIRE_TYPES[type] === LengthDelimited) for (const value of values) writeScalar(writer.tag(number, LengthDelimited), type, value);
  else {
    writer.tag(number, LengthDelimited).fork();
    for (const value of values) writeScalar(writer, type, value);
    writer.join();
  }
}

function writeMessage(writer: BinaryWriter, number: number, type: MessageName, value: Content): void {
  write(type, value, writer.tag(number, LengthDelimited).fork()).join();
}

function writeScalar(writer: BinaryWriter, type: Scalar, value: unknown): void {
  if (type === "enum") writer.int32(value as number);
  else (writer[type] as (value: unknown) => BinaryWriter)(value);
}

/** True for what proto3 leaves out; minus zero is not zero. */
function isZero(value: unknown): boolean {
  if (value instanceof Uint8Array) return value.length === 0;
  return value === 0n || value === false || value === "" || Object.is(value, 0);
}
