// The token of this browser tab, and the form that asks for a pairing code. Secrets stay in the fragment (which browsers do not
// send) and in sessionStorage.

import type { EgoTouchClient } from "../../src/index.js";

const KEY = "egotouch.token";

/** The token of this tab, for plain requests; empty when there is none. */
export const storedToken = (): string => sessionStorage.getItem(KEY) ?? "";

/** Connect with what the address or an earlier page of this tab brought, and ask for a code whenever the server wants one. */
export function startWithAccess(client: EgoTouchClient, dialog: HTMLDialogElement): void {
  const [form, field, why] = [dialog.querySelector("form")!, dialog.querySelector("input")!, dialog.querySelector("[data-why]")!];
  let tried = false;
  const start = (given: { token: string; pairingCode: string }) => {
    tried = Boolean(given.token || given.pairingCode);
    client.start(given);
  };
  client.onToken((token) => sessionStorage.setItem(KEY, token));
  client.onAccessWanted((reason) => {
    sessionStorage.removeItem(KEY);
    why.textContent = tried ? `That one is wrong or used up. ${reason}` : reason;
    field.value = "";
    if (!dialog.open) dialog.showModal();
    field.focus();
  });
  form.addEventListener("submit", (submitted) => {
    submitted.preventDefault();
    const given = field.value.trim();
    const isCode = /^\d{6}$/.test(given);
    if (!isCode) sessionStorage.setItem(KEY, given);
    dialog.close();
    start(isCode ? { token: "", pairingCode: given } : { token: given, pairingCode: "" });
  });
  start(fromFragment());
}

function fromFragment(): { token: string; pairingCode: string } {
  const given = new URLSearchParams(location.hash.slice(1));
  const [pairingCode, token] = [given.get("c") ?? "", given.get("t")];
  if (token) sessionStorage.setItem(KEY, token);
  if (pairingCode || token) history.replaceState(null, "", location.pathname + location.search);
  return { token: pairingCode ? "" : storedToken(), pairingCode };
}
