// The live view: everything the server tells, drawn. The page only listens.

import { access, askWhenWanted, keepToken } from "./access.js";
import { Connection, sameOrigin } from "./connection.js";
import { showCounters } from "./counters.js";
import { EventLog } from "./event_log.js";
import { atMostEvery, everyFrame } from "./frames.js";
import { showHands } from "./hands_panel.js";
import { LimbView } from "./limb_view.js";
import { Plot } from "./plot.js";
import { showStatus } from "./status_bar.js";
import { TouchMarks } from "./touch_marks.js";
import { FINGER_COLOURS, FINGERS, hostOf, words } from "./vocabulary.js";

const SIMULATOR = "simulator";
const PLOT_EVERY_MS = 40;
const byId = (id) => document.getElementById(id);

const connection = new Connection({
  url: sameOrigin(),
  client: "live view",
  subscribe: { status: true, landmarks: true },
  access,
  keepToken,
});
const marks = new TouchMarks();
const paint = (view, context) => marks.paint(view, context, performance.now());
const views = [new LimbView(byId("palm"), "palm", paint), new LimbView(byId("back"), "back", paint)];
const log = new EventLog(byId("log"), byId("filters"));
const force = new Plot(byId("force"), { top: 2, unit: "N" });
const latency = new Plot(byId("latency"), { top: 20, unit: "ms", dots: true });
let follow = true;
let forceNow = "";

connection.addEventListener("events", ({ detail: { events, local } }) => {
  const now = performance.now();
  log.add(events, local);
  for (const event of events) {
    if (event.late) continue;
    marks.apply(event, now);
    if (event.type === "DOWN" || event.type === "HOVER_ENTER") showHost(hostOf(event), true);
    if (event.type === "DOWN" || event.type === "MOVE") force.add(event.pointer_id, FINGER_COLOURS[event.finger], now, event.force_n);
    if (event.type === "UP" || event.type === "CANCEL") force.add(event.pointer_id, FINGER_COLOURS[event.finger], now, null);
    if (event.type === "DOWN" || event.type === "MOVE") forceNow = `${event.force_n.toFixed(2)} N`;
    if (event.type === "UP" || event.type === "CANCEL") forceNow = "";
  }
});
connection.addEventListener("timing", ({ detail }) => {
  const now = performance.now();
  latency.add("sent", "#4ade9c", now, detail.sendMs);
  latency.add("here", "#5ac8fa", now, detail.ageMs);
});
connection.addEventListener("welcome", ({ detail: { settings, features } }) => {
  if (settings.force_enter_n) force.level = { value: settings.force_enter_n, name: "onForce" };
  byId("to-simulator").hidden = !features.includes(SIMULATOR);
});

function showHost(host, fromEvent) {
  if (fromEvent && !follow) return;
  for (const view of views) view.host = host;
  byId("host-name").textContent = `${host === "LEFT" ? "Left" : "Right"} arm`;
}

byId("host").addEventListener("click", ({ target }) => {
  const host = target.dataset.host;
  if (!host) return;
  for (const button of byId("host").children) button.setAttribute("aria-pressed", String(button === target));
  follow = host === "AUTO";
  if (!follow) showHost(host, false);
});
byId("clear").addEventListener("click", () => {
  log.clear();
  force.clear();
  latency.clear();
});
for (const finger of FINGERS) {
  const item = document.createElement("li");
  item.textContent = words(finger);
  item.style.setProperty("--chip", FINGER_COLOURS[finger]);
  byId("legend").append(item);
}

function percentiles(key) {
  const [middle, high] = [0.5, 0.95].map((share) => latency.percentile(key, share)?.toFixed(1));
  return middle === undefined ? "" : `${key} ${middle} / ${high} ms`;
}

let wasBusy = true;
const drawPlots = atMostEvery(PLOT_EVERY_MS, (now) => {
  force.draw(now);
  latency.draw(now);
  byId("force-now").textContent = forceNow;
});
function draw(now) {
  if (marks.busy || wasBusy) for (const view of views) view.draw();
  wasBusy = marks.busy;
  drawPlots(now);
}

setInterval(() => {
  byId("latency-sent").textContent = percentiles("sent");
  byId("latency-here").textContent = percentiles("here");
}, 500);
showStatus(connection);
showCounters(connection, byId("counters"));
showHands(connection);
askWhenWanted(connection, byId("access"));
connection.start();
everyFrame(connection, draw);

/** For the browser's console and for tests. */
globalThis.egotouch = { connection, views, marks };
