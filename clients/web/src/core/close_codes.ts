// What a closed connection means, and whether trying again can help. Codes 40xx say "come back", 44xx "do not".

const ADVICE: Readonly<Record<number, string>> = {
  1001: "The server is going away.",
  1006: "The connection was lost.",
  1009: "This client sent a message that is too large.",
  4001: "The server has stopped.",
  4008: "This client was too slow for the server.",
  4011: "The server had an error.",
  4400: "This client is too old or too new for the server. Reload the page, or update the package.",
  4401: "This server wants a pairing code or a token. Both are shown where it was started.",
  4403: "The server refuses pages from this address. Open the address that the server prints at its start, or allow this one with --allow-origin.",
  4405: "This client broke the protocol.",
  4408: "The server did not get this client's greeting in time.",
  4409: "The server has no room for another client. Close one, then try again.",
  4421: "The server does not know itself under this name. Use the address that it prints at its start.",
  4422: "The server did not understand this client.",
  4429: "This client sent more than the server takes.",
};
const FINAL: ReadonlySet<number> = new Set([1002, 1003, 1007, 1009]);
const WRONG_TOKEN = 4401;
/** Codes whose advice says all that the server's own words would. */
const SAID: ReadonlySet<number> = new Set([1001, 4001, WRONG_TOKEN]);

export interface CloseAdvice {
  /** One or two sentences for the user. */
  readonly text: string;
  /** Whether to connect again. */
  readonly retry: boolean;
  /** Whether a token or a pairing code would help. */
  readonly access: boolean;
}

export const NO_ANSWER = "No server answers at this address. Is `egotouch serve` running?";

/**
 * What to do about a close code; `wasLive` when the server had welcomed this connection. `noAnswer` says what to look at when none was
 * made at all: browsers do not tell why.
 */
export function closeAdvice(code: number, reason: string, wasLive: boolean, noAnswer = NO_ANSWER): CloseAdvice {
  const fallback = wasLive ? "The connection was lost." : noAnswer;
  const known = code === 1006 && !wasLive ? fallback : ADVICE[code];
  const said = reason ? `${reason.charAt(0).toUpperCase()}${reason.slice(1)}${/[.!?]$/.test(reason) ? "" : "."}` : "";
  const text = [known ?? (said || fallback), known && said && !SAID.has(code) ? said : ""].filter(Boolean).join(" ");
  return { text, retry: !FINAL.has(code) && (code < 4400 || code >= 4500), access: code === WRONG_TOKEN };
}
