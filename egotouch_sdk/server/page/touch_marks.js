// Touches as marks on the drawn limb: hover rings, discs that grow with force, trails, and short flashes for what ends or clicks.

import { FINGER_COLOURS, hostOf, onPalmSide } from "./vocabulary.js";

const TRAIL_MS = 900;
const FLASH_MS = 450;
const FORCE_MAX_N = 3.5;
const FLASHES = { UP: "ring", CANCEL: "cross", CLICK: "burst", DOUBLE_CLICK: "burst", LONG_CLICK: "burst", FLING: "burst" };

export class TouchMarks {
  #pointers = new Map(); // pointer_id -> {event, touching, trail: [{event, at}]}
  #flashes = []; // {event, kind, at}

  /** True while something moves or fades, so that the views must be drawn again. */
  get busy() {
    return this.#pointers.size > 0 || this.#flashes.length > 0;
  }

  /** Take one event at `now` (milliseconds of this page's clock). */
  apply(event, now) {
    const kind = FLASHES[event.type];
    this.#expire(now); // here and not only where it is drawn: a hidden page draws nothing, yet must not grow
    if (kind) this.#flashes.push({ event, kind, at: now });
    if (event.type === "HOVER_EXIT") {
      this.#pointers.delete(event.pointer_id);
      return;
    }
    const pointer = this.#pointers.get(event.pointer_id) ?? { trail: [] };
    if (event.type === "DOWN") pointer.trail = [];
    if (event.type === "DOWN" || event.type === "MOVE") {
      for (const sample of [...event.coalesced, event]) pointer.trail.push({ event: sample, at: now });
      pointer.touching = true;
    }
    if (event.type === "UP" || event.type === "CANCEL" || event.type.startsWith("HOVER")) pointer.touching = false;
    pointer.event = event;
    this.#pointers.set(event.pointer_id, pointer);
  }

  /** Draw what belongs on this side of this host's limb. */
  paint(view, context, now) {
    const here = (event) => hostOf(event) === view.host && onPalmSide(event.surface) === (view.side === "palm");
    this.#expire(now);
    for (const pointer of this.#pointers.values()) {
      if (!here(pointer.event)) continue;
      paintTrail(view, context, pointer.trail.filter(({ event }) => here(event)), now);
      paintFinger(view, context, pointer.event, pointer.touching ? 0.34 : 0.16);
      if (pointer.touching) paintDisc(view, context, pointer.event);
      else paintHover(view, context, pointer.event);
    }
    for (const flash of this.#flashes) if (here(flash.event)) paintFlash(view, context, flash, (now - flash.at) / FLASH_MS);
  }

  #expire(now) {
    const dropOld = (list, ageMs) => {
      while (list.length && now - list[0].at > ageMs) list.shift();
    };
    dropOld(this.#flashes, FLASH_MS);
    for (const { trail } of this.#pointers.values()) dropOld(trail, TRAIL_MS);
  }
}

/** The touching finger as a shaft from its tip backwards, shortened by its pitch; also drawn by the simulator's page. */
export function paintFinger(view, context, { x_mm, y_mm, yaw_rad, pitch_rad, finger }, alpha) {
  const lengthMm = 14 + 52 * Math.cos(pitch_rad);
  const end = [x_mm - Math.sin(yaw_rad) * lengthMm, y_mm - Math.cos(yaw_rad) * lengthMm];
  const [tipX, tipY] = view.toScreen(x_mm, y_mm);
  const [endX, endY] = view.toScreen(...end);
  const fade = context.createLinearGradient(tipX, tipY, endX, endY);
  fade.addColorStop(0, withAlpha(FINGER_COLOURS[finger], alpha));
  fade.addColorStop(1, withAlpha(FINGER_COLOURS[finger], 0));
  context.strokeStyle = fade;
  context.lineCap = "round";
  context.lineWidth = 15 * view.scale;
  context.beginPath();
  context.moveTo(tipX, tipY);
  context.lineTo(endX, endY);
  context.stroke();
}

/** Radius of the disc of a touch, in millimetres. */
export const discRadiusMm = (force_n) => 4.5 + 6.5 * Math.min(force_n / FORCE_MAX_N, 1);

function paintDisc(view, context, event) {
  const [x, y] = view.toScreen(event.x_mm, event.y_mm);
  const radius = discRadiusMm(event.force_n) * view.scale;
  const colour = FINGER_COLOURS[event.finger];
  const glow = context.createRadialGradient(x, y, radius * 0.6, x, y, radius * 2);
  glow.addColorStop(0, withAlpha(colour, 0.5));
  glow.addColorStop(1, withAlpha(colour, 0));
  circle(context, x, y, radius * 2);
  context.fillStyle = glow;
  context.fill();
  circle(context, x, y, radius);
  context.fillStyle = withAlpha(colour, 0.85);
  context.fill();
  context.lineWidth = 2;
  context.strokeStyle = "#ffffff";
  context.stroke();
  label(view, context, x, y - radius, `${event.force_n.toFixed(1)} N`);
}

function paintHover(view, context, event) {
  const [x, y] = view.toScreen(event.x_mm, event.y_mm);
  circle(context, x, y, Math.max(7, 6.5 * view.scale));
  context.lineWidth = 2;
  context.setLineDash([5, 4]);
  context.strokeStyle = FINGER_COLOURS[event.finger];
  context.stroke();
  context.setLineDash([]);
}

function paintTrail(view, context, trail, now) {
  context.lineCap = "butt"; // round ends would overlap and show as beads
  for (let i = 1; i < trail.length; i += 1) {
    const fresh = 1 - (now - trail[i].at) / TRAIL_MS;
    context.beginPath();
    context.moveTo(...view.toScreen(trail[i - 1].event.x_mm, trail[i - 1].event.y_mm));
    context.lineTo(...view.toScreen(trail[i].event.x_mm, trail[i].event.y_mm));
    context.lineWidth = (1.5 + discRadiusMm(trail[i].event.force_n) * 0.7 * fresh) * view.scale;
    context.strokeStyle = withAlpha(FINGER_COLOURS[trail[i].event.finger], 0.75 * fresh);
    context.stroke();
  }
}

function paintFlash(view, context, { event, kind }, age) {
  const [x, y] = view.toScreen(event.x_mm, event.y_mm);
  context.lineWidth = kind === "burst" ? 4 * (1 - age) + 1 : 2;
  context.strokeStyle = kind === "cross" ? withAlpha("#ff6b6b", 1 - age) : withAlpha(FINGER_COLOURS[event.finger], 1 - age);
  if (kind === "cross") {
    const arm = 7 * view.scale;
    context.lineWidth = 3;
    context.beginPath();
    for (const sign of [1, -1]) {
      context.moveTo(x - arm, y - sign * arm);
      context.lineTo(x + arm, y + sign * arm);
    }
    context.stroke();
    return;
  }
  circle(context, x, y, (6 + (kind === "burst" ? 22 : 10) * age) * view.scale);
  context.stroke();
}

function label(view, context, x, y, text) {
  context.font = `600 ${Math.max(12, 5.5 * view.scale)}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "bottom";
  context.lineWidth = 4;
  context.strokeStyle = "rgb(8 12 18 / 0.8)";
  context.lineJoin = "round";
  context.strokeText(text, x, y - 6);
  context.fillStyle = "#ffffff";
  context.fillText(text, x, y - 6);
}

function circle(context, x, y, radius) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
}

function withAlpha(hex, alpha) {
  return `${hex}${Math.round(255 * Math.min(Math.max(alpha, 0), 1)).toString(16).padStart(2, "0")}`;
}
