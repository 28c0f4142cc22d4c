// The landmarks of the hands in view, in the camera's own picture; the picture itself only where the server runs a debug view.

import { access } from "./access.js";
import { atMostEvery } from "./frames.js";

const BONES = [[0, 1, 2, 3, 4], [0, 5, 6, 7, 8], [5, 9, 10, 11, 12], [9, 13, 14, 15, 16], [13, 17, 18, 19, 20], [0, 17]];
const COLOURS = { LEFT: "#f0b429", RIGHT: "#5ac8fa", UNSPECIFIED: "#93a4b8" };
const DEBUG_VIDEO = "debug_video";
const VIDEO_PATH = "debug.jpg";
const VIDEO_EVERY_MS = 60;
const PAINT_EVERY_MS = 40;

/** Show hands (and debug video, when the server announces that feature) as they come in. */
export function showHands(connection, root = document) {
  const [panel, canvas, note, video, mark] = ["camera", "hands", "camera-note", "video", "video-mark"].map((id) => root.getElementById(id));
  let last = null;
  const draw = atMostEvery(PAINT_EVERY_MS, () => {
    const { hands, width_px, height_px } = last;
    note.textContent = `${hands.length === 1 ? "1 hand" : `${hands.length} hands`}, ${width_px} × ${height_px} px`;
    paint(canvas, last);
  });
  connection.addEventListener("hands", ({ detail }) => {
    last = detail;
    panel.hidden = false;
    requestAnimationFrame(draw);
  });
  connection.addEventListener("welcome", ({ detail }) => {
    const shown = detail.features.includes(DEBUG_VIDEO);
    video.hidden = mark.hidden = !shown;
    if (!shown) return;
    panel.hidden = false;
    playVideo(video, connection);
  });
}

/** One JPEG after the other: a slow page asks for fewer, and nothing queues. */
async function playVideo(video, connection) {
  while (connection.state === "live") {
    const { token } = access();
    const response = await fetch(VIDEO_PATH, { headers: token ? { Authorization: `Bearer ${token}` } : {} }).catch(() => null);
    if (response?.status === 200) {
      const old = video.src;
      video.src = URL.createObjectURL(await response.blob());
      URL.revokeObjectURL(old);
    }
    await new Promise((resolve) => setTimeout(resolve, VIDEO_EVERY_MS));
  }
}

function paint(canvas, { width_px, height_px, hands }) {
  const ratio = Math.min(devicePixelRatio || 1, 2);
  canvas.width = Math.round(canvas.clientWidth * ratio);
  canvas.height = Math.round((canvas.clientWidth * ratio * height_px) / width_px);
  const context = canvas.getContext("2d");
  const scale = canvas.width / width_px;
  context.lineWidth = 2 * ratio;
  context.lineCap = context.lineJoin = "round";
  for (const { handedness, landmarks_px } of hands) {
    const at = (joint) => [landmarks_px[3 * joint] * scale, landmarks_px[3 * joint + 1] * scale];
    context.strokeStyle = context.fillStyle = COLOURS[handedness] ?? COLOURS.UNSPECIFIED;
    for (const bone of BONES) {
      context.beginPath();
      for (const joint of bone) context.lineTo(...at(joint));
      context.stroke();
    }
    for (let joint = 0; joint < landmarks_px.length / 3; joint += 1) {
      context.beginPath();
      context.arc(...at(joint), 2.5 * ratio, 0, 2 * Math.PI);
      context.fill();
    }
  }
}
