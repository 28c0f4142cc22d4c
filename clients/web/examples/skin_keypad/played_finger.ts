/** The mouse, pen or finger on the picture as a simulated fingertip on skin, where the server's source is the simulator. */
import type { Handedness } from "../../src/events.js";
import { toHostFrame, type Point, type SkinKeypad } from "../../src/skin/index.js";
import { isInnerSide } from "../../src/surfaces.js";
import { FINGERS, HANDS, SURFACES } from "../../src/wire/enums.js";
import type { ClientBody } from "../../src/wire/messages.js";

/** A press is played for at least this long, so that a short tap is seen by the simulated camera. */
const LEAST_PRESS_MS = 110;
/** A lifted finger stays above the skin this long, so that its touch ends with up instead of a lost hand. */
const LINGER_MS = 400;
/** The server forgets a page that is quiet for 500 ms. */
const AGAIN_MS = 100;
const HOVER_MM = 12;
const PITCH_RAD = 0.8;
/** Pressing grows from the first to the last of these, in newtons, within the time. */
const FORCE_N = { first: 0.7, last: 3.2, withinMs: 1600 };
const FULL_FORCE_N = 3.5;

interface Played {
  readonly place: Point;
  readonly host: Handedness;
  readonly inner: boolean;
  readonly yawRad: number;
  /** 0..1 of a pen, null of what has none. */
  readonly pressure: number | null;
}

/** A press: when it began, when it was first sent (null before), and whether the finger has been lifted meanwhile. */
interface Press {
  readonly began: number;
  readonly sent: number | null;
  readonly isOver: boolean;
}

/** What the finger does now, as a message; pure but for the time that is passed in. */
export class PlayedFinger {
  #played: Played | null = null;
  #press: Press | null = null;
  /** When the finger has left the picture; null while it is there. */
  #left: number | null = null;
  #sentAt = -Infinity;
  #wasThere = false;

  /** The finger is over or on a place of the limb that carries the keypad; `pressure` is that of a pen. */
  move(place: Point, { host, surface, axes }: SkinKeypad, pressure: number | null): void {
    // The other hand reaches over from below and from its own side.
    const [x, y] = toHostFrame(axes, host === "left" ? [-0.5, 0.87] : [0.5, 0.87]);
    this.#played = { place, host, inner: isInnerSide(surface), yawRad: Math.atan2(x, y), pressure };
    this.#left = null;
  }

  press(now: number): void {
    this.#press = { began: now, sent: null, isOver: false };
  }

  lift(): void {
    if (this.#press) this.#press = { ...this.#press, isOver: true };
  }

  /** The finger has left the picture: it lifts, stays a moment above the skin, and is gone. */
  leave(now: number): void {
    this.lift();
    this.#left ??= now;
  }

  /** Take the hand away at once, as a camera that loses it would. */
  vanish(): void {
    this.#played = this.#press = this.#left = null;
  }

  /** The message that is due at `now`; null when there is nothing to say. `changed` says that the finger has moved or pressed. */
  message(now: number, changed: boolean): ClientBody | null {
    const isLifted = this.#settle(now);
    const played = this.#played;
    if (!played && !this.#wasThere) return null;
    if (played && !changed && !isLifted && !this.#press && now - this.#sentAt < AGAIN_MS) return null;
    if (this.#press) this.#press = { ...this.#press, sent: this.#press.sent ?? now };
    this.#wasThere = played !== null;
    this.#sentAt = now;
    return { case: "simulated", value: { pointers: played ? [this.#pointer(played, now)] : [] } };
  }

  /** End what is over; true when the finger has just been lifted. */
  #settle(now: number): boolean {
    const press = this.#press;
    const isLifted = press !== null && press.isOver && press.sent !== null && now >= press.sent + LEAST_PRESS_MS;
    if (isLifted) {
      this.#press = null;
      if (this.#left !== null) this.#left = now;
    }
    if (this.#left !== null && !this.#press && now >= this.#left + LINGER_MS) this.vanish();
    return isLifted;
  }

  #pointer({ place: [xMm, yMm], host, inner, yawRad, pressure }: Played, now: number): object {
    const press = this.#press;
    const onHand = yMm >= 0;
    const surface = inner ? (onHand ? "palm" : "inner_forearm") : onHand ? "back_of_hand" : "outer_forearm";
    const share = press ? Math.min((now - press.began) / FORCE_N.withinMs, 1) : 0;
    const grown = FORCE_N.first + (FORCE_N.last - FORCE_N.first) * share;
    return {
      id: 1,
      hand: HANDS.number(host === "left" ? "right" : "left"),
      finger: FINGERS.number("index"),
      surface: SURFACES.number(surface),
      xMm,
      yMm,
      hoverMm: press ? 0 : HOVER_MM,
      forceN: !press ? 0 : pressure === null ? grown : Math.max(pressure * FULL_FORCE_N, 0.1),
      pitchRad: PITCH_RAD,
      yawRad,
    };
  }
}
