// What differs between browsers, Node and tests: sockets, time, and where the server is.

import { NO_ANSWER } from "./core/close_codes.js";
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

/** Refuses what is no address of a WebSocket. */
export function checkAddress(url: string | URL): void {
  if (URL.canParse(url) && /^wss?:$/.test(new URL(url).protocol)) return;
  throw new EgoTouchError("config", `"${String(url)}" is no address of a server`, "Give one such as ws://localhost:8765/");
}

/** What keeps a page from a server that may well be running; browsers themselves do not say. */
export function noAnswerAt(url: string | URL | undefined): string {
  if (url === undefined || typeof location === "undefined") return NO_ANSWER;
  const { protocol, hostname, host } = new URL(url);
  if (protocol === "wss:") return `${NO_ANSWER} If its certificate is its own: open https://${host}/ once and accept it.`;
  if (location.protocol !== "https:" || hostname === "localhost" || hostname === "127.0.0.1") return NO_ANSWER;
  return `${NO_ANSWER} This page came over https: browsers let it reach ws:// addresses of the local network only after asking, and some never do.`;
}

/** The address of the server that sent this page. */
export function sameOrigin(): string {
  if (typeof location === "undefined") throw new EgoTouchError("config", "there is no page here that a server sent", "Pass the option url");
  return `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/`;
}
