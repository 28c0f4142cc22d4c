// The header of all pages: connection state, what to do about it, and the server's own numbers.

import type { ConnectionState, EgoTouchClient, GateReason } from "../../src/index.js";
import { byId } from "./vocabulary.js";

const GATE: Readonly<Record<GateReason, string>> = {
  open: "a finger is near the skin",
  no_hands: "no hand in view",
  no_host: "one hand in view, waiting for the other",
  too_far: "hands too far apart",
  no_active_finger: "no finger points at the skin",
};
/** States that need a word of explanation. */
const TROUBLE: ReadonlySet<ConnectionState> = new Set(["disconnected", "stale"]);
const LABELS: Readonly<Record<ConnectionState, string>> = {
  disconnected: "Disconnected", connecting: "Connecting", live: "Live", stale: "Stale",
};

/** Keep the header of the page up to date with `client`. */
export function showStatus(client: EgoTouchClient): void {
  const [pill, detail, server, notice] = ["pill", "detail", "server", "notice"].map((id) => byId(id)) as [HTMLElement, HTMLElement, HTMLElement, HTMLElement];
  let gate: GateReason = "no_hands";
  const show = () => {
    pill.textContent = LABELS[client.state];
    pill.dataset["state"] = document.body.dataset["state"] = client.state;
    detail.textContent = TROUBLE.has(client.state) ? client.detail : "";
    if (client.state !== "live") server.textContent = "";
  };
  client.onState(show);
  client.onTrackingChanged((state) => (gate = state.gate));
  client.onStatus(({ source, fps }) => {
    server.textContent = [source, fps ? `${fps.toFixed(0)} frames/s` : "", GATE[gate]].filter(Boolean).join(" · ");
  });
  client.onWarning((warning) => {
    notice.textContent = warning.message;
    notice.hidden = false;
  });
  show();
}
