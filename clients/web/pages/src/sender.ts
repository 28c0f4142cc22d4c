// Sends what is played: at most 75 times a second, and ten times a second while nothing changes, as the server forgets a page
// that has gone quiet.

import type { EgoTouchClient, Handedness } from "../../src/index.js";
import { FINGERS as FINGER_NUMBERS, HANDS, SURFACES } from "../../src/wire/enums.js";
import type { PlayedFinger } from "./played_fingers.js";

const LEAST_MS = 1000 / 75;
const AGAIN_MS = 100;

export class PointerSender {
  readonly #client: EgoTouchClient;
  #sent = "";
  #at = 0;

  constructor(client: EgoTouchClient) {
    this.#client = client;
    client.onWelcome(() => (this.#sent = ""));
  }

  /** Send `fingers` when they are new or the last message is old; `host` is the touched arm. True when they were sent. */
  offer(fingers: readonly PlayedFinger[], host: Handedness, now: number): boolean {
    if (now - this.#at < LEAST_MS) return false;
    const hand = HANDS.number(host === "left" ? "right" : "left");
    const pointers = fingers.map((played) => ({
      ...played, hand, finger: FINGER_NUMBERS.number(played.finger), surface: SURFACES.number(played.surface),
    }));
    const text = JSON.stringify(pointers);
    if (text === this.#sent && (!pointers.length || now - this.#at < AGAIN_MS)) return false;
    if (!this.#client.send({ case: "simulated", value: { pointers } })) return false;
    this.#sent = text;
    this.#at = now;
    return true;
  }
}
