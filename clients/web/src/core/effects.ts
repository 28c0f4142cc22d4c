// What a session is told once, and what it gives: work for the shell and news for the app.

import type { MessageInitShape } from "@bufbuild/protobuf";
import type { EgoTouchError } from "../errors.js";
import type { TouchBatch } from "../events.js";
import type { HandsView, Status, SubscribeSchema, Warning, Welcome } from "../gen/egotouch/v1/egotouch_pb.js";
import type { Violation } from "./verifier.js";

export type ConnectionState = "disconnected" | "connecting" | "live" | "stale";
/** What to send; empty or absent lists mean everything. */
export type Subscribe = MessageInitShape<typeof SubscribeSchema>;

export interface SessionOptions {
  /** Name and version of the app in the Hello. */
  readonly name: string;
  readonly version: string;
  readonly subscribe: Subscribe;
  /** Check the event grammar. */
  readonly debug: boolean;
  /** An event older than this on arrival does not act; null takes the server's own limit. */
  readonly inputTtlMs: number | null;
  readonly random: () => number;
  /** What to tell the user when no connection could be made. */
  readonly noAnswer?: string;
}

/** What the shell has to do, and what the app is told, in this order. */
export type Effect =
  | { readonly kind: "open" }
  | { readonly kind: "send"; readonly data: Uint8Array<ArrayBuffer> }
  | { readonly kind: "close" }
  | { readonly kind: "state"; readonly state: ConnectionState; readonly detail: string }
  | { readonly kind: "welcome"; readonly welcome: Welcome }
  | { readonly kind: "token"; readonly token: string }
  | { readonly kind: "access"; readonly reason: string }
  | { readonly kind: "batch"; readonly batch: TouchBatch }
  | { readonly kind: "status"; readonly status: Status }
  | { readonly kind: "hands"; readonly hands: HandsView }
  | { readonly kind: "warning"; readonly warning: Warning }
  | { readonly kind: "violation"; readonly violation: Violation }
  | { readonly kind: "error"; readonly error: EgoTouchError };
