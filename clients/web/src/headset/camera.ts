// This device's camera as the server's source: `egotouch serve client`.

import type { EgoTouchClient } from "../client.js";
import { EgoTouchError } from "../errors.js";
import { FrameSlot, type FrameCounts } from "./frame_slot.js";
import { handsMessage, type PushedHand } from "./hands.js";

export interface CameraOptions {
  /** Frames per second at most (default 30). */
  readonly fps?: number;
  /** Asked of the camera (default 1280 x 720); what it gives instead is sent as it is. */
  readonly widthPx?: number;
  readonly heightPx?: number;
  /** 0..1, of the JPEG (default 0.8). */
  readonly quality?: number;
  /** Which camera; by default one that looks away from the user. */
  readonly deviceId?: string;
  /** Hands of the frame captured at `capturedMs` (`performance.now()`), where the device tracks them; null for "not known now". */
  readonly hands?: (capturedMs: number) => readonly PushedHand[] | null;
}

/** A camera whose frames are being sent. */
export interface CameraSource {
  readonly video: HTMLVideoElement;
  readonly counts: FrameCounts;
  /** Stop sending and release the camera. */
  stop(): void;
  /** Settled when the camera has ended: after `stop()`, or because it was taken away. */
  readonly ended: Promise<void>;
}

/** The server closes the connection at messages over 1 MiB. */
const MOST_BYTES = 1_000_000;

const REFUSED: Readonly<Record<string, string>> = {
  NotAllowedError: "Allow the camera for this page; on a headset the browser itself needs the camera permission too",
  NotFoundError: "Connect a camera",
  NotReadableError: "Close the app that uses the camera now",
  OverconstrainedError: "Leave deviceId out, or give that of a camera that is connected",
};

/** Send this device's camera to the server as long as `client` is live; rejects with a "device" error when there is no camera to use. */
export async function sendCamera(client: EgoTouchClient, options: CameraOptions = {}): Promise<CameraSource> {
  const { fps = 30, quality = 0.8 } = options;
  const stream = await openCamera(options);
  const video = document.createElement("video");
  Object.assign(video, { muted: true, playsInline: true, srcObject: stream });
  await video.play();
  const coder = new FrameCoder(quality);
  const slot = new FrameSlot(fps);
  let isOn = true;

  const take = async (capturedMs: number) => {
    if (client.state !== "live") return;
    const timestampNs = slot.offer(capturedMs, client.bufferedAmount);
    if (timestampNs === null) return;
    const hands = options.hands?.(capturedMs) ?? null;
    const jpeg = await coder.code(video).catch(() => null);
    if (jpeg && jpeg.length > MOST_BYTES) coder.coarsen();
    const isSent = isOn && jpeg !== null && jpeg.length <= MOST_BYTES && client.send({ case: "frame", value: { jpeg, timestampNs } });
    if (isSent && hands) client.send({ case: "hands", value: handsMessage(hands, timestampNs) });
    slot.done(isSent);
  };
  const next = () => video.requestVideoFrameCallback((now, { captureTime }) => {
    if (!isOn) return;
    next();
    void take(captureTime ?? now);
  });
  next();

  let end = () => {};
  const ended = new Promise<void>((resolve) => (end = resolve));
  const stop = () => {
    isOn = false;
    for (const track of stream.getTracks()) track.stop();
    end();
  };
  stream.getVideoTracks()[0]?.addEventListener("ended", stop);
  return {
    video,
    get counts() {
      return slot.counts;
    },
    stop,
    ended,
  };
}

async function openCamera({ fps = 30, widthPx = 1280, heightPx = 720, deviceId }: CameraOptions): Promise<MediaStream> {
  if (!navigator.mediaDevices) {
    throw new EgoTouchError("device", "browsers give no camera to this page", "Open it from localhost or over https");
  }
  const which = deviceId ? { deviceId: { exact: deviceId } } : { facingMode: "environment" };
  try {
    return await navigator.mediaDevices.getUserMedia({
      audio: false, video: { ...which, width: { ideal: widthPx }, height: { ideal: heightPx }, frameRate: { ideal: fps } },
    });
  } catch (error) {
    const name = error instanceof DOMException ? error.name : "";
    throw new EgoTouchError("device", `there is no camera: ${String(error)}`, REFUSED[name] ?? "");
  }
}

/** JPEGs of a video, one at a time. */
class FrameCoder {
  readonly #canvas = new OffscreenCanvas(2, 2);
  #quality: number;

  constructor(quality: number) {
    this.#quality = quality;
  }

  /** A picture was too large to be sent: code the next ones with less detail. */
  coarsen(): void {
    this.#quality *= 0.7;
  }

  async code(video: HTMLVideoElement): Promise<Uint8Array<ArrayBuffer>> {
    const { videoWidth, videoHeight } = video;
    if (this.#canvas.width !== videoWidth) this.#canvas.width = videoWidth;
    if (this.#canvas.height !== videoHeight) this.#canvas.height = videoHeight;
    this.#canvas.getContext("2d", { alpha: false })!.drawImage(video, 0, 0);
    const blob = await this.#canvas.convertToBlob({ type: "image/jpeg", quality: this.#quality });
    return new Uint8Array(await blob.arrayBuffer());
  }
}
