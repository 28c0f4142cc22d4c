// The fingers that mouse, pen, touch screen and keys play on the drawn limb, ready to be sent.

import type { Finger, Surface } from "../../src/index.js";
import { FINGERS } from "./vocabulary.js";

/** A press lasts at least this long: a tap on a touch pad takes a few milliseconds, less than the time between two frames. */
const LEAST_PRESS_MS = 90;
/** A lifted touch hovers this long before its finger leaves, so that it ends with UP instead of a lost hand. */
const LINGER_MS = 350;
/** Where the second finger is put while Shift is held: sideways from the first, in millimetres of the picture. */
const BESIDE_MM = 24;
const FORCE_MAX_N = 3.5;
/** The time of a press that has not been sent yet. */
const UNPLAYED = null;

/** What a pen says of itself. */
export interface Pen {
  readonly forceN: number;
  readonly pitchRad?: number;
  readonly yawRad?: number;
}

/** A DOM pointer, or the keys, on the canvas: CSS pixels. */
export interface PlayingPointer {
  readonly id: number | string;
  readonly x: number;
  readonly y: number;
  readonly pen: Pen | null;
}

/** One finger as it is sent. */
export interface PlayedFinger {
  readonly id: number;
  readonly finger: Finger;
  readonly surface: Surface;
  readonly xMm: number;
  readonly yMm: number;
  readonly hoverMm: number;
  readonly forceN: number;
  readonly pitchRad: number;
  readonly yawRad: number;
}

/** What the controls say. */
export interface PlayingSettings {
  readonly finger: Finger;
  readonly forceN: number;
  readonly pitchRad: number;
  readonly yawRad: number;
  readonly hoverMm: number;
  readonly hoverOnly: boolean;
  readonly deviceForce: boolean;
}

/** What this needs of a `LimbView`. */
export interface PlayingView {
  toMm(x: number, y: number): readonly [number, number];
  isOnSkin(x: number, y: number): boolean;
  surfaceAt(yMm: number): Surface;
}

interface Held {
  id: number;
  finger: Finger;
  xMm: number;
  yMm: number;
  down: boolean;
  pressed: number | null;
  pen: Pen | null;
  shift: boolean;
  gone: number | null;
}

const isFresh = (pressed: number | null, now: number) => pressed === UNPLAYED || now - pressed < LEAST_PRESS_MS;

export class PlayedFingers {
  /** By the id of the DOM pointer that plays the finger. */
  readonly #fingers = new Map<number | string, Held>();
  readonly #settings: () => PlayingSettings;
  readonly #view: PlayingView;

  constructor(view: PlayingView, settings: () => PlayingSettings) {
    this.#view = view;
    this.#settings = settings;
  }

  /** Follow a DOM pointer; `down` while it presses. Off the skin a finger lifts. */
  move(pointer: PlayingPointer, { down, now, shift = false }: { down: boolean; now: number; shift?: boolean }): void {
    const [xMm, yMm] = this.#view.toMm(pointer.x, pointer.y);
    const onSkin = this.#view.isOnSkin(pointer.x, pointer.y);
    const known = this.#fingers.get(pointer.id);
    if (!known && !onSkin) return;
    const claimed = known ?? this.#claim();
    if (!claimed) return;
    const { id, finger } = claimed;
    const presses = down && onSkin;
    const pressed = presses && !known?.down ? UNPLAYED : known ? known.pressed : -Infinity;
    const pen = presses || !isFresh(pressed, now) || !known ? pointer.pen : known.pen; // a lifted pen has no pressure any more
    this.#fingers.set(pointer.id, { id, finger, xMm, yMm, down: presses, pressed, pen, shift, gone: null });
    if (!onSkin && !down) this.leave(pointer.id, now);
  }

  /** True while any finger presses. */
  get pressing(): boolean {
    return [...this.#fingers.values()].some((finger) => finger.down);
  }

  /** A DOM pointer has lifted or gone out of the picture: its finger hovers a moment, then leaves. */
  leave(pointerId: number | string, now: number): void {
    const finger = this.#fingers.get(pointerId);
    if (finger && finger.gone === null) Object.assign(finger, { down: false, gone: now + LINGER_MS });
  }

  /** Take the hand away at once: what touches is cancelled by the server, as when a camera loses a hand. */
  vanish(): void {
    this.#fingers.clear();
  }

  /** The chosen finger has changed: those that hover become it. */
  choose(): void {
    const hovering = [...this.#fingers.entries()].filter(([, finger]) => !finger.down);
    for (const [key] of hovering) this.#fingers.delete(key);
    for (const [key, finger] of hovering) this.#fingers.set(key, { ...finger, ...this.#claim() });
  }

  /** What is played at `now`. */
  at(now: number): PlayedFinger[] {
    const settings = this.#settings();
    const played: PlayedFinger[] = [];
    for (const [key, finger] of this.#fingers) {
      if (finger.gone !== null && now >= finger.gone && finger.pressed !== UNPLAYED) {
        this.#fingers.delete(key);
        continue;
      }
      played.push(this.#place(finger, settings, now));
      if (finger.shift) played.push(...this.#second(finger, settings, now));
    }
    return played;
  }

  /** What `at` gave has been sent. */
  noteSent(now: number): void {
    for (const finger of this.#fingers.values()) {
      if (finger.pressed !== UNPLAYED) continue;
      finger.pressed = now;
      if (finger.gone !== null) finger.gone = now + LINGER_MS;
    }
  }

  #place({ id, finger, xMm, yMm, down, pressed, pen }: Held, settings: PlayingSettings, now: number): PlayedFinger {
    const touching = (down || isFresh(pressed, now)) && !settings.hoverOnly;
    const device: Partial<Pen> = settings.deviceForce && pen ? pen : {};
    return {
      id,
      finger,
      surface: this.#view.surfaceAt(yMm),
      xMm,
      yMm,
      hoverMm: touching ? 0 : settings.hoverMm,
      forceN: touching ? Math.min(device.forceN ?? settings.forceN, FORCE_MAX_N) : 0,
      pitchRad: device.pitchRad ?? settings.pitchRad,
      yawRad: device.yawRad ?? settings.yawRad,
    };
  }

  #second(first: Held, settings: PlayingSettings, now: number): PlayedFinger[] {
    const finger = this.#order().find((candidate) => !this.#taken(candidate));
    if (!finger) return [];
    const beside = { ...first, id: first.id + 100, finger, xMm: first.xMm + BESIDE_MM };
    return [this.#place(beside, settings, now)];
  }

  #taken(finger: Finger): boolean {
    return [...this.#fingers.values()].some((played) => played.finger === finger);
  }

  /** The chosen finger, its neighbours (the one farther from the thumb first), the rest. */
  #order(): Finger[] {
    const chosen = FINGERS.indexOf(this.#settings().finger);
    const distance = (finger: Finger) => Math.abs(FINGERS.indexOf(finger) - chosen - 0.1);
    return [...FINGERS].sort((a, b) => distance(a) - distance(b));
  }

  /** The first finger in order that is free or about to leave, so that a second tap is the same finger's; and an id for it. */
  #claim(): { id: number; finger: Finger } | null {
    for (const finger of this.#order()) {
      const held = [...this.#fingers].find(([, played]) => played.finger === finger);
      if (held === undefined) return { id: this.#freeId(), finger };
      const [key, holder] = held;
      if (holder.gone !== null) {
        this.#fingers.delete(key);
        return { id: holder.id, finger };
      }
    }
    return null;
  }

  #freeId(): number {
    const taken = new Set([...this.#fingers.values()].map((finger) => finger.id));
    let id = 1;
    while (taken.has(id)) id += 1;
    return id;
  }
}

/** Force and angles of a pen, from a DOM PointerEvent; null for what has no pressure of its own. */
export function penOf(event: PointerEvent, view: { readonly thumbwards: number }): Pen | null {
  if (event.pointerType !== "pen") return null;
  const pen = { forceN: event.pressure * FORCE_MAX_N };
  const [altitude, azimuth] = [event.altitudeAngle, event.azimuthAngle];
  if (altitude === undefined || altitude >= Math.PI / 2 - 0.01) return pen; // upright or without tilt: the sliders hold
  // A pen leans away from where it points: azimuth is 0 along the picture's +x and grows clockwise.
  const [right, up] = [-Math.cos(azimuth), Math.sin(azimuth)];
  return { ...pen, pitchRad: altitude, yawRad: Math.atan2(right * view.thumbwards, up) };
}
