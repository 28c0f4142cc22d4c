// Touches as marks on the drawn limb: hover rings, discs that grow with force, trails, and short flashes for what ends or clicks.

import type { EventType, Finger, TouchEvent } from "../../src/index.js";
import type { LimbView } from "./limb_view.js";
import { FINGER_COLOURS, onPalmSide } from "./vocabulary.js";

const TRAIL_MS = 900;
const FLASH_MS = 450;
const FORCE_MAX_N = 3.5;
type FlashKind = "ring" | "cross" | "burst";
const FLASHES: Readonly<Partial<Record<EventType, FlashKind>>> = { up: "ring", cancel: "cross", click: "burst", double_click: "burst", long_click: "burst", fling: "burst" };

interface Sample {
  readonly event: TouchEvent;
  readonly at: number;
}

interface Flash extends Sample {
  readonly kind: FlashKind;
}

interface Mark {
  event: TouchEvent;
  touching: boolean;
  trail: Sample[];
}

export class TouchMarks {
  readonly #pointers = new Map<number, Mark>();
  readonly #flashes: Flash[] = [];

  /** True while something moves or fades, so that the views must be drawn again. */
  get busy(): boolean {
    return this.#pointers.size > 0 || this.#flashes.length > 0;
  }

  /** Take one event at `now` (milliseconds of this page's clock). */
  apply(event: TouchEvent, now: number): void {
    const kind = FLASHES[event.type];
    this.#expire(now); // here and not only where it is drawn: a hidden page draws nothing, yet must not grow
    if (kind) this.#flashes.push({ event, kind, at: now });
    if (event.type === "hover_exit") {
      this.#pointers.delete(event.pointerId);
      return;
    }
    const pointer = this.#pointers.get(event.pointerId) ?? { event, touching: false, trail: [] };
    if (event.type === "down") pointer.trail = [];
    if (event.type === "down" || event.type === "move") {
      for (const sample of [...event.coalesced, event]) pointer.trail.push({ event: sample, at: now });
      pointer.touching = true;
    }
    if (event.type === "up" || event.type === "cancel" || event.type.startsWith("hover")) pointer.touching = false;
    pointer.event = event;
    this.#pointers.set(event.pointerId, pointer);
  }

  /** Draw what belongs on this side of this host's limb. */
  paint(view: LimbView, context: CanvasRenderingContext2D, now: number): void {
    const labels: Label[] = [];
    const here = (event: TouchEvent) => event.hostHand === view.host && onPalmSide(event.surface) === (view.side === "palm");
    this.#expire(now);
    for (const pointer of this.#pointers.values()) {
      if (!here(pointer.event)) continue;
      paintTrail(view, context, pointer.trail.filter(({ event }) => here(event)), now);
      paintFinger(view, context, pointer.event, pointer.touching ? 0.34 : 0.16);
      if (pointer.touching) labels.push(paintDisc(view, context, pointer.event));
      else paintHover(view, context, pointer.event);
    }
    for (const flash of this.#flashes) if (here(flash.event)) paintFlash(view, context, flash, (now - flash.at) / FLASH_MS);
    paintLabels(view, context, labels);
  }

  #expire(now: number): void {
    const dropOld = (list: Sample[], ageMs: number) => {
      while (list[0] && now - list[0].at > ageMs) list.shift();
    };
    dropOld(this.#flashes, FLASH_MS);
    for (const { trail } of this.#pointers.values()) dropOld(trail, TRAIL_MS);
  }
}

/** How a finger lies: a touch event or a played finger. */
export interface FingerPose {
  readonly xMm: number;
  readonly yMm: number;
  readonly yawRad: number;
  readonly pitchRad: number;
  readonly finger: Finger;
}

/** The touching finger as a shaft from its tip backwards, shortened by its pitch; also drawn by the simulator's page. */
export function paintFinger(view: LimbView, context: CanvasRenderingContext2D, at: FingerPose, alpha: number): void {
  const { xMm, yMm, yawRad, pitchRad, finger } = at;
  const lengthMm = 14 + 52 * Math.cos(pitchRad);
  const end: [number, number] = [xMm - Math.sin(yawRad) * lengthMm, yMm - Math.cos(yawRad) * lengthMm];
  const [tipX, tipY] = view.toScreen(xMm, yMm);
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
export const discRadiusMm = (forceN: number): number => 4.5 + 6.5 * Math.min(forceN / FORCE_MAX_N, 1);

function paintDisc(view: LimbView, context: CanvasRenderingContext2D, event: TouchEvent): Label {
  const [x, y] = view.toScreen(event.xMm, event.yMm);
  const radius = discRadiusMm(event.forceN) * view.scale;
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
  return { x, y, radius, text: `${event.forceN.toFixed(1)} N` };
}

function paintHover(view: LimbView, context: CanvasRenderingContext2D, event: TouchEvent): void {
  const [x, y] = view.toScreen(event.xMm, event.yMm);
  circle(context, x, y, Math.max(7, 6.5 * view.scale));
  context.lineWidth = 2;
  context.setLineDash([5, 4]);
  context.strokeStyle = FINGER_COLOURS[event.finger];
  context.stroke();
  context.setLineDash([]);
}

function paintTrail(view: LimbView, context: CanvasRenderingContext2D, trail: readonly Sample[], now: number): void {
  context.lineCap = "butt"; // round ends would overlap and show as beads
  for (let i = 1; i < trail.length; i += 1) {
    const [{ event: before }, { event, at }] = [trail[i - 1]!, trail[i]!];
    const fresh = 1 - (now - at) / TRAIL_MS;
    context.beginPath();
    context.moveTo(...view.toScreen(before.xMm, before.yMm));
    context.lineTo(...view.toScreen(event.xMm, event.yMm));
    context.lineWidth = (1.5 + discRadiusMm(event.forceN) * 0.7 * fresh) * view.scale;
    context.strokeStyle = withAlpha(FINGER_COLOURS[event.finger], 0.75 * fresh);
    context.stroke();
  }
}

function paintFlash(view: LimbView, context: CanvasRenderingContext2D, { event, kind }: Flash, age: number): void {
  const [x, y] = view.toScreen(event.xMm, event.yMm);
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

/** What is written at a disc. */
interface Label {
  readonly x: number;
  readonly y: number;
  readonly radius: number;
  readonly text: string;
}

/** Space between a disc and its label, in CSS pixels. */
const GAP = 6;

/** Labels stand above their discs; where two would overlap, the later one stands below. */
function paintLabels(view: LimbView, context: CanvasRenderingContext2D, labels: readonly Label[]): void {
  const height = Math.max(12, 5.5 * view.scale);
  context.font = `600 ${height}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineWidth = 4;
  context.strokeStyle = "rgb(8 12 18 / 0.8)";
  context.lineJoin = "round";
  context.fillStyle = "#ffffff";
  const written: { readonly x: number; readonly y: number; readonly width: number }[] = [];
  for (const { x, y, radius, text } of labels) {
    const { width } = context.measureText(text);
    const away = radius + GAP + height / 2;
    const isTaken = (at: number) => written.some((other) => Math.abs(other.x - x) < (other.width + width) / 2 + GAP && Math.abs(other.y - at) < height);
    const at = isTaken(y - away) ? y + away : y - away;
    written.push({ x, y: at, width });
    context.strokeText(text, x, at);
    context.fillText(text, x, at);
  }
}

function circle(context: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
}

function withAlpha(hex: string, alpha: number): string {
  return `${hex}${Math.round(255 * Math.min(Math.max(alpha, 0), 1)).toString(16).padStart(2, "0")}`;
}
