// The simulator: the user's pointer is the finger; what the server makes of it comes back over the same connection.

import { EgoTouchClient, type TouchEvent } from "../../src/index.js";
import { startWithAccess } from "./access.js";
import { Controls } from "./controls.js";
import { EventLog } from "./event_log.js";
import { atMostEvery, everyFrame } from "./frames.js";
import { playWith } from "./limb_input.js";
import { LimbView } from "./limb_view.js";
import { PlayedFingers, type PlayedFinger } from "./played_fingers.js";
import { Plot } from "./plot.js";
import { PointerSender } from "./sender.js";
import { ForceRecord } from "./force_record.js";
import { showStatus } from "./status_bar.js";
import { paintFinger, TouchMarks } from "./touch_marks.js";
import { byId, whole, words } from "./vocabulary.js";

const SIMULATOR = "simulator";
const PLOT_EVERY_MS = 40;
/** Shorter than the sender's least pause, so that what is played goes out at its full rate. */
const PLAY_EVERY_MS = 7;

// What comes late is still shown: this page acts on nothing.
const client = new EgoTouchClient({ name: "simulator", version: "1", subscribe: { status: true }, inputTtlMs: Infinity });
const marks = new TouchMarks();
let played: readonly PlayedFinger[] = [];
const view = new LimbView(byId<HTMLCanvasElement>("limb"), "palm", (limb, context) => {
  marks.paint(limb, context, performance.now());
  for (const finger of played) paintFinger(limb, context, finger, 0.18);
});
const fingers = new PlayedFingers(view, () => controls.settings);
const controls: Controls = new Controls(view, () => {
  fingers.choose();
  view.refresh();
});
const sender = new PointerSender(client);
const log = new EventLog(byId("log"), byId("filters"));
const force = new Plot(byId<HTMLCanvasElement>("force-plot"), { top: 2, unit: "N" });
const forces = new ForceRecord(force);

client.onBatch(({ events }) => {
  const now = performance.now();
  log.add(events);
  for (const event of events) if (!event.late) show(event, now);
});
client.onWelcome(({ features, settings }) => {
  if (settings?.forceEnterN) force.level = { value: settings.forceEnterN, name: "onForce" };
  byId("notice").hidden = features.includes(SIMULATOR);
  byId("notice").textContent = "This server plays another source. To touch here, start it with: egotouch simulate";
});
byId("clear").addEventListener("click", () => {
  log.clear();
  force.clear();
});

function show(event: TouchEvent, now: number): void {
  marks.apply(event, now);
  forces.take(event, now);
}

function describe(pointers: readonly PlayedFinger[]): string {
  if (!pointers.length) return "Press on the skin.";
  return pointers
    .map(({ finger, surface, xMm, yMm, hoverMm, forceN }) => {
      const how = hoverMm === 0 ? `${forceN.toFixed(1)} N` : `hovers at ${hoverMm} mm`;
      return `${words(finger)}: ${words(surface)}, x ${whole(xMm)}, y ${whole(yMm)} mm, ${how}`;
    })
    .join(" · ");
}

let wasBusy = true;
const drawPlot = atMostEvery(PLOT_EVERY_MS, (now) => {
  force.draw(now);
  byId("force-now").textContent = forces.text;
});
function play(): void {
  const now = performance.now();
  played = fingers.at(now);
  if (sender.offer(played, view.host, now)) fingers.noteSent(now);
}
function draw(now: number): void {
  const busy = marks.busy || played.length > 0;
  if (busy || wasBusy) {
    byId("place").textContent = describe(played);
    view.draw();
  }
  wasBusy = busy;
  drawPlot(now);
}

showStatus(client);
playWith(view, fingers, controls);
startWithAccess(client, byId<HTMLDialogElement>("access"));
setInterval(play, PLAY_EVERY_MS);
everyFrame(client, draw);

/** For the browser's console and for tests. */
Object.assign(globalThis, { egotouch: { client, view, marks, fingers } });
