// The page of a headset or phone whose own camera is the server's source: `egotouch serve client`.

import { sendCamera, type CameraSource } from "../../src/headset/index.js";
import { EgoTouchClient, EgoTouchError } from "../../src/index.js";
import { startWithAccess } from "./access.js";
import { EventLog } from "./event_log.js";
import { ForceRecord } from "./force_record.js";
import { atMostEvery, everyFrame } from "./frames.js";
import { Plot } from "./plot.js";
import { showStatus } from "./status_bar.js";
import { byId } from "./vocabulary.js";

const PUSH_FRAMES = "push_frames";
const COUNT_EVERY_MS = 500;
const PLOT_EVERY_MS = 40;
const OTHER_SOURCE = "This server has another source. To send this device's camera, start it with: egotouch serve client";

const client = new EgoTouchClient({ name: "camera", version: "1", subscribe: { status: true }, inputTtlMs: Infinity });
const log = new EventLog(byId("log"), byId("filters"));
const force = new Plot(byId<HTMLCanvasElement>("force"), { top: 2, unit: "N" });
const forces = new ForceRecord(force);
const button = byId<HTMLButtonElement>("switch");
const device = byId<HTMLSelectElement>("device");
const asleep = byId("asleep");
let camera: CameraSource | null = null;

client.onBatch(({ events }) => {
  log.add(events);
  for (const event of events) if (!event.late) forces.take(event, performance.now());
});
client.onWelcome(({ features, settings }) => {
  if (settings?.forceEnterN) force.level = { value: settings.forceEnterN, name: "onForce" };
  tell(features.includes(PUSH_FRAMES) ? "" : OTHER_SOURCE);
  button.disabled = !features.includes(PUSH_FRAMES);
});
byId("clear").addEventListener("click", () => {
  log.clear();
  force.clear();
});
button.addEventListener("click", () => void (camera ? camera.stop() : start()));
device.addEventListener("change", () => void restart());

function tell(text: string): void {
  byId("notice").textContent = text;
  byId("notice").hidden = !text;
}

async function start(): Promise<void> {
  button.disabled = true;
  try {
    const started = await sendCamera(client, device.value ? { deviceId: device.value } : {});
    camera = started;
    tell("");
    show(started.video);
    void started.ended.then(() => camera === started && show(null));
    await listCameras();
  } catch (error) {
    tell(error instanceof EgoTouchError ? error.message : String(error));
  }
  button.disabled = false;
}

async function restart(): Promise<void> {
  camera?.stop();
  await camera?.ended;
  await start();
}

/** Show the camera's own picture; null when it has ended. */
function show(video: HTMLVideoElement | null): void {
  if (!video) camera = null;
  byId("preview").replaceChildren(video ?? asleep);
  button.textContent = video ? "Stop the camera" : "Start the camera";
}

/** Names of cameras are known once one of them may be used. */
async function listCameras(): Promise<void> {
  const cameras = (await navigator.mediaDevices.enumerateDevices()).filter(({ kind }) => kind === "videoinput");
  byId("pick").hidden = cameras.length < 2;
  const running = (camera?.video.srcObject as MediaStream | null)?.getVideoTracks()[0]?.getSettings().deviceId ?? "";
  device.replaceChildren(...cameras.map(({ label, deviceId }) => new Option(label || "Camera", deviceId, false, deviceId === running)));
}

const figures = ["Sent", "Left out", "Per second"].map((label) => {
  const [pair, value, term] = [document.createElement("div"), document.createElement("dd"), document.createElement("dt")];
  term.textContent = label;
  value.textContent = "–";
  pair.append(value, term);
  byId("counters").append(pair);
  return value;
});
let before = { sent: 0, atMs: performance.now() };
setInterval(() => {
  if (!camera) return;
  const [{ sent, skipped }, now] = [camera.counts, performance.now()];
  const perSecond = (Math.max(0, sent - before.sent) * 1000) / (now - before.atMs);
  before = { sent, atMs: now };
  [sent, skipped, perSecond.toFixed(0)].forEach((value, i) => (figures[i]!.textContent = String(value)));
  byId("size").textContent = `${camera.video.videoWidth} × ${camera.video.videoHeight} px`;
}, COUNT_EVERY_MS);

showStatus(client);
startWithAccess(client, byId<HTMLDialogElement>("access"));
everyFrame(client, atMostEvery(PLOT_EVERY_MS, (now) => {
  force.draw(now);
  byId("force-now").textContent = forces.text;
}));

/** For the browser's console and for tests. */
Object.assign(globalThis, { egotouch: { client, get camera() { return camera; } } });
