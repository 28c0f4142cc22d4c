// The header of both pages: connection state, what to do about it, and the server's own numbers.

import { words } from "./vocabulary.js";

const GATE = {
  OPEN: "a finger is near the skin",
  NO_HANDS: "no hand in view",
  NO_HOST: "one hand in view, waiting for the other",
  TOO_FAR: "hands too far apart",
  NO_ACTIVE_FINGER: "no finger points at the skin",
};
/** States that need a word of explanation. */
const TROUBLE = new Set(["disconnected", "stale"]);
const LABELS = { disconnected: "Disconnected", connecting: "Connecting", live: "Live", stale: "Stale" };

/** Keep the header of the page up to date with `connection`. */
export function showStatus(connection, root = document) {
  const [pill, detail, server, notice] = ["pill", "detail", "server", "notice"].map((id) => root.getElementById(id));
  const show = () => {
    pill.textContent = LABELS[connection.state];
    pill.dataset.state = document.body.dataset.state = connection.state;
    detail.textContent = TROUBLE.has(connection.state) ? connection.detail : "";
    if (connection.state !== "live") server.textContent = "";
  };
  connection.addEventListener("state", show);
  connection.addEventListener("status", ({ detail: status }) => {
    const parts = [status.source, status.fps ? `${status.fps.toFixed(0)} frames/s` : "", GATE[status.gate] ?? words(status.gate)];
    server.textContent = parts.filter(Boolean).join(" · ");
  });
  connection.addEventListener("warning", ({ detail: warning }) => {
    notice.textContent = warning.message;
    notice.hidden = false;
  });
  show();
}
