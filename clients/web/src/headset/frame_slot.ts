// Decides which camera frames are worth sending: one is coded at a time, and none while the last ones wait in the socket.

/** What became of the frames so far. */
export interface FrameCounts {
  readonly sent: number;
  /** Frames that came while an older one was being coded or waited to be sent. */
  readonly skipped: number;
}

/** Bytes that may wait in the socket: a picture or two. More would only grow older. */
const MOST_WAITING_BYTES = 256 * 1024;
/** Frames must rise in time; two that the browser stamps alike are this far apart. */
const LEAST_STEP_NS = 1000n;

export class FrameSlot {
  #isCoding = false;
  #lastNs = -1n;
  #sent = 0;
  #skipped = 0;
  #dueMs = -Infinity;
  readonly #everyMs: number;

  /** `fps` is the highest rate. */
  constructor(fps: number) {
    this.#everyMs = 1000 / fps;
  }

  get counts(): FrameCounts {
    return { sent: this.#sent, skipped: this.#skipped };
  }

  /** A frame captured at `capturedMs` has come; gives its time for the server, or null when it is to be left out. */
  offer(capturedMs: number, waitingBytes: number): bigint | null {
    if (capturedMs < this.#dueMs) return null;
    if (this.#isCoding || waitingBytes > MOST_WAITING_BYTES) {
      this.#skipped += 1;
      return null;
    }
    // A camera that is a little faster or slower than asked must not lose every second frame.
    this.#dueMs = capturedMs + 0.7 * this.#everyMs;
    this.#isCoding = true;
    const timestampNs = BigInt(Math.round(capturedMs * 1e6));
    this.#lastNs = timestampNs > this.#lastNs + LEAST_STEP_NS ? timestampNs : this.#lastNs + LEAST_STEP_NS;
    return this.#lastNs;
  }

  /** The frame has been coded, and sent unless there was no connection. */
  done(wasSent: boolean): void {
    this.#isCoding = false;
    if (wasSent) this.#sent += 1;
    else this.#skipped += 1;
  }
}
