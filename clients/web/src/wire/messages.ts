// Bytes to messages and back.

import type { MessageInitShape } from "@bufbuild/protobuf";
import { EgoTouchError } from "../errors.js";
import type { ClientMessageSchema, ServerMessage } from "../gen/egotouch/v1/egotouch_pb.js";
import { decode, encode } from "./codec.js";

/** The body of a message to the server, for example `{ case: "simulated", value: { pointers: [] } }`. */
export type ClientBody = NonNullable<MessageInitShape<typeof ClientMessageSchema>["body"]>;

/** The message in these bytes; what a newer server added is passed over. Throws for bytes that are no message. */
export function decodeServerMessage(data: Uint8Array): ServerMessage {
  try {
    return decode("ServerMessage", data) as ServerMessage;
  } catch (error) {
    throw new EgoTouchError("protocol", `malformed message: ${data.length} bytes are no ServerMessage (${String(error)})`);
  }
}

export function encodeClientMessage(body: ClientBody): Uint8Array<ArrayBuffer> {
  return encode("ClientMessage", { body });
}
