// What differs between browsers, Node and tests: sockets, time, and where the server is.

import { EgoTouchError } from "./errors.js";

/** The WebSocket class of a browser, of the package `ws`, or of a test. */
export type SocketConstructor = new (url: string | URL, protocols?: string | string[]) => unknown;

/** Time in milliseconds and a timer. */
export interface Clock {
  nowMs(): number;
  setInterval(work: () => void, everyMs: number): unknown;
  clearInterval(timer: unknown): void;
}

export const systemClock: Clock = {
  nowMs: () => performance.now(),
  setInterval: (work, everyMs) => globalThis.setInterval(work, everyMs),
  clearInterval: (timer) => globalThis.clearInterval(timer as number),
};

/** The address of the server that sent this page. */
export function sameOrigin(): string {
  if (typeof location === "undefined") throw new EgoTouchError("config", "there is no page here that a server sent", "Pass the option url");
  return `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/`;
}
