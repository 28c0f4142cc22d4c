// Figures about the link, refreshed a few times a second.

const EVERY_MS = 250;

/** Fill the <dl> with figures of `connection`. */
export function showCounters(connection, list) {
  const rows = [
    ["Edges", "Events that are never merged or dropped", (counts) => counts.edges],
    ["Moves", "Events that may be merged", (counts) => counts.moves],
    ["Merged", "Older moves that came inside newer ones", (counts) => counts.merged],
    ["Cancelled here", "Touches that this page ended by itself when the server fell silent", (counts) => counts.cancelledHere],
    ["Reconnects", "Times the link was lost", (counts) => counts.reconnects],
    ["Clock ±", "Bound of the error of all latencies, in milliseconds", () => round(connection.clock.uncertaintyMs)],
  ];
  const values = rows.map(([label, title]) => {
    const [term, value] = [document.createElement("dt"), document.createElement("dd")];
    const pair = document.createElement("div");
    pair.title = title;
    term.textContent = label;
    pair.append(value, term);
    list.append(pair);
    return value;
  });
  const show = () => rows.forEach(([, , read], i) => (values[i].textContent = read(connection.counts)));
  setInterval(show, EVERY_MS);
  show();
}

const round = (ms) => (ms === null ? "–" : `${ms.toFixed(1)} ms`);
