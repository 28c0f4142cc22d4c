// What a closed connection means to the user, and whether trying again can help. Codes 40xx say "come back", 44xx "do not".

const ADVICE = {
  1001: "The server is going away.",
  1006: "The connection was lost.",
  1009: "This page sent a message that is too large.",
  4001: "The server has stopped.",
  4008: "This page was too slow for the server.",
  4011: "The server had an error.",
  4400: "This page is too old or too new for the server. Reload it.",
  4401: "This server wants a pairing code or a token. Both are shown where it was started.",
  4403: "The server refuses pages from this address. Open the address that the server prints at its start.",
  4405: "This page broke the protocol. Reload it.",
  4408: "The server did not get this page's greeting in time. Reload it.",
  4409: "The server has no room for another client. Close one, then reload this page.",
  4421: "The server does not know itself under this name. Open the address that it prints at its start.",
  4422: "The server did not understand this page. Reload it.",
  4429: "This page sent more than the server takes. Reload it.",
};
const FINAL = new Set([1002, 1003, 1007, 1009]);
const ACCESS = new Set([4401]);
/** Codes whose advice says all that the server's own words would. */
const SAID = new Set([1001, 4001, 4401]);

/** `{text, retry, access}`: one sentence, whether to reconnect, whether a token or code would help. */
export function closeAdvice(code, reason, wasLive) {
  const fallback = wasLive ? "The connection was lost." : "No server answers at this address. Is `egotouch serve` running?";
  const known = code === 1006 && !wasLive ? fallback : ADVICE[code];
  const said = reason ? `${reason.charAt(0).toUpperCase()}${reason.slice(1)}${/[.!?]$/.test(reason) ? "" : "."}` : "";
  const text = [known ?? (said || fallback), known && said && !SAID.has(code) ? said : ""].filter(Boolean).join(" ");
  return { text, retry: !FINAL.has(code) && (code < 4400 || code >= 4500), access: ACCESS.has(code) };
}
