// The simulator: the user's pointer is the finger; what the server makes of it comes back over the same connection.

import { access, askWhenWanted, keepToken } from "./access.js";
import { Connection, sameOrigin } from "./connection.js";
import { Controls } from "./controls.js";
import { EventLog } from "./event_log.js";
import { playWith } from "./limb_input.js";
import { atMostEvery, everyFrame } from "./frames.js";
import { LimbView } from "./limb_view.js";
import { PlayedFingers } from "./played_fingers.js";
import { Plot } from "./plot.js";
import { PointerSender } from "./sender.js";
import { showStatus } from "./status_bar.js";
import { paintFinger, TouchMarks } from "./touch_marks.js";
import { FINGER_COLOURS, words } from "./vocabulary.js";

const SIMULATOR = "simulator";
const PLOT_EVERY_MS = 40;
/** Shorter than the sender's least pause, so that what is played goes out at its full rate. */
const PLAY_EVERY_MS = 7;
const byId = (id) => document.getElementById(id);

const connection = new Connection({ url: sameOrigin(), client: "simulator", subscribe: { status: true }, access, keepToken });
const marks = new TouchMarks();
let played = [];
let forceNow = "";
const view = new LimbView(byId("limb"), "palm", (limb, context) => {
  marks.paint(limb, context, performance.now());
  for (const pointer of played) paintFinger(limb, context, pointer, 0.18);
});
const fingers = new PlayedFingers(view, () => controls.settings);
const controls = new Controls(view, () => fingersChanged());
const sender = new PointerSender(connection);
const log = new EventLog(byId("log"), byId("filters"));
const force = new Plot(byId("force-plot"), { top: 2, unit: "N" });

function fingersChanged() {
  fingers.choose();
  view.refresh();
}

connection.addEventListener("events", ({ detail: { events, local } }) => {
  const now = performance.now();
  log.add(events, local);
  for (const event of events) {
    if (event.late) continue;
    marks.apply(event, now);
    const ended = event.type === "UP" || event.type === "CANCEL";
    if (!ended && event.type !== "DOWN" && event.type !== "MOVE") continue;
    force.add(event.pointer_id, FINGER_COLOURS[event.finger], now, ended ? null : event.force_n);
    forceNow = ended ? "" : `${event.force_n.toFixed(2)} N`;
  }
});
connection.addEventListener("welcome", ({ detail: { features, settings } }) => {
  if (settings.force_enter_n) force.level = { value: settings.force_enter_n, name: "onForce" };
  byId("notice").hidden = features.includes(SIMULATOR);
  byId("notice").textContent = "This server plays another source. To touch here, start it with: egotouch simulate";
});
byId("clear").addEventListener("click", () => {
  log.clear();
  force.clear();
});

function describe(pointers) {
  if (!pointers.length) return "Press on the skin.";
  return pointers
    .map(({ finger, surface, x_mm, y_mm, hover_mm, force_n }) => {
      const how = hover_mm === 0 ? `${force_n.toFixed(1)} N` : `hovers at ${hover_mm} mm`;
      return `${words(finger)}: ${words(surface)}, x ${x_mm.toFixed(0)}, y ${y_mm.toFixed(0)} mm, ${how}`;
    })
    .join(" · ");
}

let wasBusy = true;
const drawPlot = atMostEvery(PLOT_EVERY_MS, (now) => {
  force.draw(now);
  byId("force-now").textContent = forceNow;
});
function play() {
  const now = performance.now();
  played = fingers.at(now);
  if (sender.offer(played, view.host, now)) fingers.noteSent(now);
}
function draw(now) {
  const busy = marks.busy || played.length > 0;
  if (busy || wasBusy) {
    byId("place").textContent = describe(played);
    view.draw();
  }
  wasBusy = busy;
  drawPlot(now);
}

showStatus(connection);
askWhenWanted(connection, byId("access"));
playWith(view, fingers, controls);
connection.start();
setInterval(play, PLAY_EVERY_MS);
everyFrame(connection, draw);

/** For the browser's console and for tests. */
globalThis.egotouch = { connection, view, marks, fingers };
