// A plain log of the events; token or pairing code come in the fragment, which never leaves the browser.
const state = document.getElementById("state");
const log = document.getElementById("log");
const secrets = new URLSearchParams(location.hash.slice(1));
const LINES = 40;

function show(text) {
  const line = document.createElement("li");
  line.textContent = text;
  log.prepend(line);
  while (log.children.length > LINES) log.lastChild.remove();
}

function describe(event) {
  const name = (text) => text.replace(/^[A-Z]+?_(TYPE_)?/, "").toLowerCase();
  const place = `(${event.x_mm.toFixed(1)}, ${event.y_mm.toFixed(1)}) mm`;
  return `${name(event.type).padEnd(13)} ${name(event.finger).padEnd(7)} ${place.padEnd(18)} ${event.force_n.toFixed(2)} N`;
}

function connect(pauseMs) {
  const socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/ws`, ["egotouch.v1.json"]);
  socket.onopen = () => {
    const token = secrets.get("t") ?? sessionStorage.getItem("token") ?? "";
    socket.send(JSON.stringify({ hello: { client: "page", token, pairing_code: token ? "" : (secrets.get("c") ?? "") } }));
  };
  socket.onmessage = ({ data }) => {
    const message = JSON.parse(data);
    if (message.welcome) {
      state.textContent = "live";
      pauseMs = 250;
      if (message.welcome.token) sessionStorage.setItem("token", message.welcome.token);
    }
    for (const event of message.batch?.events ?? []) show(describe(event));
  };
  socket.onclose = ({ code, reason }) => {
    const comesBack = code < 4100;
    state.textContent = `${comesBack ? "connecting again" : "refused"} (${code} ${reason})`;
    if (comesBack) setTimeout(() => connect(Math.min(pauseMs * 2, 5000)), pauseMs * Math.random());
  };
}

connect(250);
