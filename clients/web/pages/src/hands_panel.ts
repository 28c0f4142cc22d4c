// The landmarks of the hands in view, in the camera's own picture; the picture itself only where the server runs a debug view.

import type { EgoTouchClient, HandsView } from "../../src/index.js";
import { storedToken } from "./access.js";
import { atMostEvery } from "./frames.js";
import { byId } from "./vocabulary.js";

const BONES = [[0, 1, 2, 3, 4], [0, 5, 6, 7, 8], [5, 9, 10, 11, 12], [9, 13, 14, 15, 16], [13, 17, 18, 19, 20], [0, 17]];
/** By the number of the side in the schema: unknown, left, right. */
const COLOURS = ["#93a4b8", "#f0b429", "#5ac8fa"];
const DEBUG_VIDEO = "debug_video";
const VIDEO_PATH = "debug.jpg";
const VIDEO_EVERY_MS = 60;
const PAINT_EVERY_MS = 40;

/** Show hands (and debug video, when the server announces that feature) as they come in. */
export function showHands(client: EgoTouchClient): void {
  const [panel, note, mark] = ["camera", "camera-note", "video-mark"].map((id) => byId(id)) as [HTMLElement, HTMLElement, HTMLElement];
  const [canvas, video] = [byId<HTMLCanvasElement>("hands"), byId<HTMLImageElement>("video")];
  let last: HandsView | null = null;
  const draw = atMostEvery(PAINT_EVERY_MS, () => {
    if (!last) return;
    const { hands, widthPx, heightPx } = last;
    note.textContent = `${hands.length === 1 ? "1 hand" : `${hands.length} hands`}, ${widthPx} × ${heightPx} px`;
    paint(canvas, last);
  });
  client.onHands((hands) => {
    last = hands;
    panel.hidden = false;
    requestAnimationFrame(draw);
  });
  client.onWelcome(({ features }) => {
    const shown = features.includes(DEBUG_VIDEO);
    video.hidden = mark.hidden = !shown;
    if (!shown) return;
    panel.hidden = false;
    void playVideo(video, client);
  });
}

/** One JPEG after the other: a slow page asks for fewer, and nothing queues. */
async function playVideo(video: HTMLImageElement, client: EgoTouchClient): Promise<void> {
  while (client.state === "live") {
    const token = storedToken();
    const response = await fetch(VIDEO_PATH, { headers: token ? { Authorization: `Bearer ${token}` } : {} }).catch(() => null);
    if (response?.status === 200) {
      const old = video.src;
      video.src = URL.createObjectURL(await response.blob());
      URL.revokeObjectURL(old);
    }
    await new Promise((resolve) => setTimeout(resolve, VIDEO_EVERY_MS));
  }
}

function paint(canvas: HTMLCanvasElement, { widthPx, heightPx, hands }: HandsView): void {
  if (!widthPx || !heightPx) return;
  const ratio = Math.min(devicePixelRatio || 1, 2);
  canvas.width = Math.round(canvas.clientWidth * ratio);
  canvas.height = Math.round((canvas.clientWidth * ratio * heightPx) / widthPx);
  const context = canvas.getContext("2d")!;
  const scale = canvas.width / widthPx;
  context.lineWidth = 2 * ratio;
  context.lineCap = context.lineJoin = "round";
  for (const { handedness, landmarksPx } of hands) {
    const at = (joint: number): [number, number] => [(landmarksPx[3 * joint] ?? 0) * scale, (landmarksPx[3 * joint + 1] ?? 0) * scale];
    context.strokeStyle = context.fillStyle = COLOURS[handedness] ?? COLOURS[0]!;
    for (const bone of BONES) {
      context.beginPath();
      for (const joint of bone) context.lineTo(...at(joint));
      context.stroke();
    }
    for (let joint = 0; joint < landmarksPx.length / 3; joint += 1) {
      context.beginPath();
      context.arc(...at(joint), 2.5 * ratio, 0, 2 * Math.PI);
      context.fill();
    }
  }
}
