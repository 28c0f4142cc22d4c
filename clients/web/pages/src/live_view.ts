// The live view: everything the server tells, drawn. The page only listens.

import { EgoTouchClient, type Handedness, type TouchEvent } from "../../src/index.js";
import { startWithAccess } from "./access.js";
import { showCounters } from "./counters.js";
import { EventLog } from "./event_log.js";
import { ForceRecord } from "./force_record.js";
import { atMostEvery, everyFrame } from "./frames.js";
import { showHands } from "./hands_panel.js";
import { LimbView, type Paint } from "./limb_view.js";
import { Plot } from "./plot.js";
import { showStatus } from "./status_bar.js";
import { TouchMarks } from "./touch_marks.js";
import { byId, FINGER_COLOURS, FINGERS, words } from "./vocabulary.js";

/** Features of a server whose source is a page, and the links to that page. */
const SOURCE_PAGES = { simulator: "to-simulator", push_frames: "to-camera" };
const PLOT_EVERY_MS = 40;

// What comes late is still shown: this page acts on nothing.
const client = new EgoTouchClient({ name: "live view", version: "1", subscribe: { status: true, landmarks: true }, inputTtlMs: Infinity });
const marks = new TouchMarks();
const paint: Paint = (view, context) => marks.paint(view, context, performance.now());
const views = [new LimbView(byId<HTMLCanvasElement>("palm"), "palm", paint), new LimbView(byId<HTMLCanvasElement>("back"), "back", paint)];
const log = new EventLog(byId("log"), byId("filters"));
const force = new Plot(byId<HTMLCanvasElement>("force"), { top: 2, unit: "N" });
const forces = new ForceRecord(force);
const latency = new Plot(byId<HTMLCanvasElement>("latency"), { top: 20, unit: "ms", dots: true });
let follow = true;

client.onBatch(({ events, sendMs, latencyMs, late }) => {
  const now = performance.now();
  log.add(events);
  for (const event of events) if (!event.late) show(event, now);
  if (late || sendMs === null || latencyMs === null) return;
  latency.add("sent", "#4ade9c", now, sendMs);
  latency.add("here", "#5ac8fa", now, latencyMs);
});
client.onWelcome(({ settings, features }) => {
  if (settings?.forceEnterN) force.level = { value: settings.forceEnterN, name: "onForce" };
  for (const [feature, link] of Object.entries(SOURCE_PAGES)) byId(link).hidden = !features.includes(feature);
});

function show(event: TouchEvent, now: number): void {
  marks.apply(event, now);
  forces.take(event, now);
  if (event.type === "down" || event.type === "hover_enter") showHost(event.hostHand, true);
}

function showHost(host: Handedness, fromEvent: boolean): void {
  if (fromEvent && !follow) return;
  for (const view of views) view.host = host;
  byId("host-name").textContent = `${host === "left" ? "Left" : "Right"} arm`;
}

byId("host").addEventListener("click", ({ target }) => {
  const { host } = (target as HTMLElement).dataset;
  if (!host) return;
  for (const button of byId("host").children) button.setAttribute("aria-pressed", String(button === target));
  follow = host === "auto";
  if (host !== "auto") showHost(host as Handedness, false);
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

function percentiles(key: string): string {
  const [middle, high] = [0.5, 0.95].map((share) => {
    const ms = latency.percentile(key, share);
    return ms?.toFixed(ms < 100 ? 1 : 0);
  });
  return middle === undefined ? "" : `${key} ${middle} / ${high} ms`;
}

let wasBusy = true;
const drawPlots = atMostEvery(PLOT_EVERY_MS, (now) => {
  force.draw(now);
  latency.draw(now);
  byId("force-now").textContent = forces.text;
});
function draw(now: number): void {
  if (marks.busy || wasBusy) for (const view of views) view.draw();
  wasBusy = marks.busy;
  drawPlots(now);
}

setInterval(() => {
  byId("latency-sent").textContent = percentiles("sent");
  byId("latency-here").textContent = percentiles("here");
}, 500);
showStatus(client);
showCounters(client, byId("counters"));
showHands(client);
startWithAccess(client, byId<HTMLDialogElement>("access"));
everyFrame(client, draw);

/** For the browser's console and for tests. */
Object.assign(globalThis, { egotouch: { client, views, marks } });
