/** The mouse, pen or finger on the picture as a simulated fingertip on skin, where the server's source is the simulator. */
import type { Handedness } from "../../src/events.js";
import { toHostFrame, type Point, type SkinKeypad } from "../../src/skin/index.js";
import { isInnerSide } from "../../src/surfaces.js";
import { FINGERS, HANDS, SURFACES } from "../../src/wire/enums.js";
import type { ClientBody } from "../../src/wire/messages.js";

/** A press lasts at least this long, so that a short tap is seen by the simulated camera. */
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
  readonly pressedAt: number | null;
  readonly liftAt: number;
  readonly goneAt: number;
  /** 0..1 of a pen, null of what has none. */
  readonly pressure: number | null;
}

/** What the finger does now, as a message; pure but for the time that is passed in. */
export class PlayedFinger {
  #played: Played | null = null;
  #sentAt = -Infinity;
  #wasThere = false;

  /** The finger is over or on a place of the limb that carries the keypad; `pressure` is that of a pen. */
  move(place: Point, { host, surface, axes }: SkinKeypad, pressure: number | null): void {
    const { pressedAt, liftAt } = this.#played ?? { pressedAt: null, liftAt: Infinity };
    // The other hand reaches over from below and from its own side.
    const [x, y] = toHostFrame(axes, host === "left" ? [-0.5, 0.87] : [0.5, 0.87]);
    const yawRad = Math.atan2(x, y);
    this.#played = { place, host, inner: isInnerSide(surface), yawRad, pressedAt, liftAt, goneAt: Infinity, pressure };
  }

  press(now: number): void {
    if (this.#played) this.#played = { ...this.#played, pressedAt: now, liftAt: Infinity, goneAt: Infinity };
  }

  lift(now: number): void {
    const played = this.#played;
    if (played?.pressedAt != null) this.#played = { ...played, liftAt: Math.max(now, played.pressedAt + LEAST_PRESS_MS) };
  }

  /** The finger has left the picture: it lifts, stays a moment above the skin, and is gone. */
  leave(now: number): void {
    this.lift(now);
    const played = this.#played;
    if (played) this.#played = { ...played, goneAt: Math.max(now, played.liftAt === Infinity ? now : played.liftAt) + LINGER_MS };
  }

  /** Take the hand away at once, as a camera that loses it would. */
  vanish(): void {
    this.#played = null;
  }

  /** The message that is due at `now`; null when there is nothing to say. */
  message(now: number, changed: boolean): ClientBody | null {
    let played = this.#played;
    if (played && now >= played.liftAt) played = { ...played, pressedAt: null, liftAt: Infinity };
    if (played && now >= played.goneAt) played = null;
    const edge = played !== this.#played;
    this.#played = played;
    if (!played && !this.#wasThere) return null;
    if (played && !changed && !edge && played.pressedAt === null && now - this.#sentAt < AGAIN_MS) return null;
    this.#wasThere = played !== null;
    this.#sentAt = now;
    return { case: "simulated", value: { pointers: played ? [this.#pointer(played, now)] : [] } };
  }

  #pointer({ place: [xMm, yMm], host, inner, yawRad, pressedAt, pressure }: Played, now: number): object {
    const onHand = yMm >= 0;
    const surface = inner ? (onHand ? "palm" : "inner_forearm") : onHand ? "back_of_hand" : "outer_forearm";
    const share = pressedAt === null ? 0 : Math.min((now - pressedAt) / FORCE_N.withinMs, 1);
    const grown = FORCE_N.first + (FORCE_N.last - FORCE_N.first) * share;
    return {
      id: 1,
      hand: HANDS.number(host === "left" ? "right" : "left"),
      finger: FINGERS.number("index"),
      surface: SURFACES.number(surface),
      xMm,
      yMm,
      hoverMm: pressedAt === null ? HOVER_MM : 0,
      forceN: pressedAt === null ? 0 : pressure === null ? grown : Math.max(pressure * FULL_FORCE_N, 0.1),
      pitchRad: PITCH_RAD,
      yawRad,
    };
  }
}
