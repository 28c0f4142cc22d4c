// The fingers that mouse, pen, touch screen and keys play on the drawn limb, ready to be sent.

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

const isFresh = (pressed, now) => pressed === UNPLAYED || now - pressed < LEAST_PRESS_MS;

export class PlayedFingers {
  #fingers = new Map(); // DOM pointer id -> {id, finger, x_mm, y_mm, down, pressed, pen, gone}
  #settings;
  #view;

  /** `settings()` gives `{finger, force_n, pitch_rad, yaw_rad, hover_mm, hoverOnly, deviceForce}`. */
  constructor(view, settings) {
    this.#view = view;
    this.#settings = settings;
  }

  /** Follow a DOM pointer; `down` while it presses. Off the skin a finger lifts. */
  move(pointer, { down, now, shift = false }) {
    const [x_mm, y_mm] = this.#view.toMm(pointer.x, pointer.y);
    const onSkin = this.#view.isOnSkin(pointer.x, pointer.y);
    const known = this.#fingers.get(pointer.id);
    if (!known && !onSkin) return;
    const { id, finger } = known ?? this.#claim();
    if (!finger) return;
    const presses = down && onSkin;
    const pressed = presses && !known?.down ? UNPLAYED : known ? known.pressed : -Infinity;
    const pen = presses || !isFresh(pressed, now) ? pointer.pen : known.pen; // a lifted pen has no pressure any more
    this.#fingers.set(pointer.id, { id, finger, x_mm, y_mm, down: presses, pressed, pen, shift, gone: null });
    if (!onSkin && !down) this.leave(pointer.id, now);
  }

  /** True while any finger presses. */
  get pressing() {
    return [...this.#fingers.values()].some((finger) => finger.down);
  }

  /** A DOM pointer has lifted or gone out of the picture: its finger hovers a moment, then leaves. */
  leave(pointer_id, now) {
    const finger = this.#fingers.get(pointer_id);
    if (finger && finger.gone === null) Object.assign(finger, { down: false, gone: now + LINGER_MS });
  }

  /** Take the hand away at once: what touches is cancelled by the server, as when a camera loses a hand. */
  vanish() {
    this.#fingers.clear();
  }

  /** The chosen finger has changed: those that hover become it. */
  choose() {
    const hovering = [...this.#fingers.entries()].filter(([, finger]) => !finger.down);
    for (const [key] of hovering) this.#fingers.delete(key);
    for (const [key, finger] of hovering) this.#fingers.set(key, { ...finger, ...this.#claim() });
  }

  /** What is played at `now`, as SimulatedPointer fields with short enum names. */
  at(now) {
    const settings = this.#settings();
    const played = [];
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
  noteSent(now) {
    for (const finger of this.#fingers.values()) {
      if (finger.pressed !== UNPLAYED) continue;
      finger.pressed = now;
      if (finger.gone !== null) finger.gone = now + LINGER_MS;
    }
  }

  #place({ id, finger, x_mm, y_mm, down, pressed, pen }, settings, now) {
    const touching = (down || isFresh(pressed, now)) && !settings.hoverOnly;
    const device = settings.deviceForce && pen ? pen : {};
    return {
      id,
      finger,
      surface: this.#view.surfaceAt(y_mm),
      x_mm,
      y_mm,
      hover_mm: touching ? 0 : settings.hover_mm,
      force_n: touching ? Math.min(device.force_n ?? settings.force_n, FORCE_MAX_N) : 0,
      pitch_rad: device.pitch_rad ?? settings.pitch_rad,
      yaw_rad: device.yaw_rad ?? settings.yaw_rad,
    };
  }

  #second(first, settings, now) {
    const finger = this.#order().find((candidate) => !this.#taken(candidate));
    if (!finger) return [];
    const beside = { ...first, id: first.id + 100, finger, x_mm: first.x_mm + BESIDE_MM };
    return [this.#place(beside, settings, now)];
  }

  #taken(finger) {
    return [...this.#fingers.values()].some((played) => played.finger === finger);
  }

  /** The chosen finger, its neighbours (the one farther from the thumb first), the rest. */
  #order() {
    const chosen = FINGERS.indexOf(this.#settings().finger);
    const distance = (finger) => Math.abs(FINGERS.indexOf(finger) - chosen - 0.1);
    return [...FINGERS].sort((a, b) => distance(a) - distance(b));
  }

  /** The first finger in order that is free or about to leave, so that a second tap is the same finger's; and an id for it. */
  #claim() {
    for (const finger of this.#order()) {
      const [key, holder] = [...this.#fingers].find(([, played]) => played.finger === finger) ?? [];
      if (holder === undefined) return { id: this.#freeId(), finger };
      if (holder.gone !== null) {
        this.#fingers.delete(key);
        return { id: holder.id, finger };
      }
    }
    return {};
  }

  #freeId() {
    const taken = new Set([...this.#fingers.values()].map((finger) => finger.id));
    let id = 1;
    while (taken.has(id)) id += 1;
    return id;
  }
}

/** Force and angles of a pen, from a DOM PointerEvent; null for what has no pressure of its own. */
export function penOf(event, view) {
  if (event.pointerType !== "pen") return null;
  const pen = { force_n: event.pressure * FORCE_MAX_N };
  const [altitude, azimuth] = [event.altitudeAngle, event.azimuthAngle];
  if (altitude === undefined || altitude >= Math.PI / 2 - 0.01) return pen; // upright or without tilt: the sliders hold
  // A pen leans away from where it points: azimuth is 0 along the picture's +x and grows clockwise.
  const [right, up] = [-Math.cos(azimuth), Math.sin(azimuth)];
  return { ...pen, pitch_rad: altitude, yaw_rad: Math.atan2(right * view.thumbwards, up) };
}
