/** Token and pairing code, as the server's other pages keep them: in the fragment, which browsers do not send, and for the tab. */
import type { EgoTouchClient } from "../../src/index.js";

const KEY = "egotouch.token";

/** Start with what the address or an earlier page brought, and ask for a code whenever the server wants one. */
export function startWithAccess(client: EgoTouchClient, dialog: HTMLDialogElement): void {
  const form = dialog.querySelector("form")!;
  const field = dialog.querySelector("input")!;
  const why = dialog.querySelector("[data-why]")!;
  client.onToken((token) => sessionStorage.setItem(KEY, token));
  client.onAccessWanted((reason) => {
    sessionStorage.removeItem(KEY);
    why.textContent = reason;
    field.value = "";
    if (!dialog.open) dialog.showModal();
    field.focus();
  });
  form.addEventListener("submit", (submitted) => {
    submitted.preventDefault();
    const given = field.value.trim();
    dialog.close();
    if (/^\d{6}$/.test(given)) return void client.start({ token: "", pairingCode: given });
    sessionStorage.setItem(KEY, given);
    client.start({ token: given, pairingCode: "" });
  });
  const fragment = new URLSearchParams(location.hash.slice(1));
  const pairingCode = fragment.get("c") ?? "";
  const token = fragment.get("t") ?? sessionStorage.getItem(KEY) ?? "";
  if (fragment.has("t")) sessionStorage.setItem(KEY, token);
  if (fragment.size) history.replaceState(null, "", location.pathname + location.search);
  client.start(pairingCode ? { pairingCode } : { token });
}
