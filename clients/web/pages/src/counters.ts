// Figures about the link, refreshed a few times a second.

import type { EgoTouchClient } from "../../src/index.js";

const EVERY_MS = 250;

/** Fill the <dl> with figures of `client`. */
export function showCounters(client: EgoTouchClient, list: HTMLElement): void {
  const rows: readonly (readonly [string, string, () => string | number])[] = [
    ["Edges", "Events that are never merged or dropped", () => client.stats.edges],
    ["Moves", "Events that may be merged", () => client.stats.moves],
    ["Merged", "Older moves that came inside newer ones", () => client.stats.merged],
    ["Cancelled here", "Touches that this page ended by itself when the server fell silent", () => client.stats.cancelledHere],
    ["Reconnects", "Times the link was lost", () => client.stats.reconnects],
    ["Clock ±", "Bound of the error of all latencies, in milliseconds", () => milliseconds(client.clockUncertaintyMs)],
  ];
  const values = rows.map(([label, title]) => {
    const [term, value, pair] = [document.createElement("dt"), document.createElement("dd"), document.createElement("div")];
    pair.title = title;
    term.textContent = label;
    pair.append(value, term);
    list.append(pair);
    return value;
  });
  const show = () => rows.forEach(([, , read], i) => (values[i]!.textContent = String(read())));
  setInterval(show, EVERY_MS);
  show();
}

const milliseconds = (ms: number | null) => (ms === null ? "–" : `${ms.toFixed(1)} ms`);
