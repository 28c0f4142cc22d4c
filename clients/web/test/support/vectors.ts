// The golden vectors of proto/vectors, and the log lines that a client's calls are compared with.

import { readFileSync, readdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import type { Effect } from "../../src/core/effects.js";
import { Session } from "../../src/core/session.js";
import type { TouchEvent } from "../../src/events.js";
import { METHODS } from "../../src/listeners/touch_listener.js";

const FOLDER = fileURLToPath(new URL("../../../../proto/vectors/", import.meta.url));

/** Names of all streams, without those of their spoiled twins. */
export const STREAMS = readdirSync(FOLDER).filter((name) => name.endsWith(".log")).map((name) => name.slice(0, -4));

export const readText = (name: string) => readFileSync(FOLDER + name, "utf8");

/** The messages of a `.bin` file; null where the connection is lost. */
export function readMessages(name: string): (Uint8Array | null)[] {
  const data = readFileSync(FOLDER + name);
  const messages: (Uint8Array | null)[] = [];
  for (let at = 0; at < data.length; ) {
    let length = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = data[at++]!;
      length |= (byte & 0x7f) << shift;
      if (byte < 0x80) break;
    }
    messages.push(length ? data.subarray(at, at + length) : null);
    at += length;
  }
  return messages;
}

/** Follows one stream of messages as an app's client does; time stands still but for the silence at the end. */
export class Replay {
  readonly events: TouchEvent[] = [];
  readonly errors: unknown[] = [];
  readonly session = new Session({ name: "vectors", version: "", subscribe: {}, debug: true, inputTtlMs: Infinity, random: () => 0 });

  get log(): string[] {
    return this.events.map(logLine);
  }

  constructor() {
    this.#note(this.session.start(0));
    this.#note(this.session.opened(0));
  }

  receive(message: Uint8Array | null): void {
    if (message) {
      this.#note(this.session.received(message, 0));
      return;
    }
    this.#note(this.session.closed(1006, "", 0));
    this.#note(this.session.tick(0));
    this.#note(this.session.opened(0));
  }

  /** The end of the file: more silence than is allowed. */
  end(): void {
    this.#note(this.session.closed(1006, "", 0));
    this.#note(this.session.tick(1));
    this.#note(this.session.tick(301));
    this.#note(this.session.tick(352));
  }

  #note(effects: readonly Effect[]): void {
    for (const effect of effects) {
      if (effect.kind === "batch") this.events.push(...effect.batch.events);
      if (effect.kind === "error" || effect.kind === "violation") this.errors.push(effect);
    }
  }
}

const thousandths = (value: number) => Math.floor(value * 1000 + 0.5);

/** One callback as the vectors' README spells it. */
export function logLine(event: TouchEvent): string {
  return (
    `${event.late ? "late " : ""}${METHODS[event.type]} ${event.type} ${event.pointerId}/${event.contactId} t_ns=${event.timestampNs}` +
    ` x_um=${thousandths(event.xMm)} y_um=${thousandths(event.yMm)} force_mn=${thousandths(event.forceN)}` +
    ` clicks=${event.clickCount} reason=${event.reason ?? "-"} merged=${event.coalesced.length}`
  );
}
