// The token of this browser tab, and the form that asks for a pairing code. Secrets stay in the fragment (which browsers do not
// send) and in sessionStorage.

const KEY = "egotouch.token";
let pairingCode = takeFromFragment();

function takeFromFragment() {
  const given = new URLSearchParams(location.hash.slice(1));
  const code = given.get("c") ?? "";
  const token = given.get("t");
  if (token) sessionStorage.setItem(KEY, token);
  if (code || token) history.replaceState(null, "", location.pathname + location.search);
  return code;
}

/** What the next Hello should carry. */
export function access() {
  return { token: pairingCode ? null : sessionStorage.getItem(KEY), pairing_code: pairingCode };
}

/** Keep the token that a pairing code was exchanged for. */
export function keepToken(token) {
  sessionStorage.setItem(KEY, token);
  pairingCode = "";
}

/** Ask for a code whenever the server wants one; `dialog` is the page's <dialog> with a form inside. */
export function askWhenWanted(connection, dialog) {
  const [form, field, why] = [dialog.querySelector("form"), dialog.querySelector("input"), dialog.querySelector("[data-why]")];
  connection.addEventListener("access", ({ detail }) => {
    const tried = pairingCode || sessionStorage.getItem(KEY);
    sessionStorage.removeItem(KEY);
    pairingCode = "";
    why.textContent = tried ? `That one is wrong or used up. ${detail.reason}` : detail.reason;
    field.value = "";
    if (!dialog.open) dialog.showModal();
    field.focus();
  });
  form.addEventListener("submit", (submitted) => {
    submitted.preventDefault();
    const given = field.value.trim();
    if (/^\d{6}$/.test(given)) pairingCode = given;
    else sessionStorage.setItem(KEY, given);
    dialog.close();
    connection.start();
  });
}
