// A finger that a test moves. It makes the events that the real engine makes of such a finger, by the same thresholds: drags, force
// presses, clicks and long clicks (not: double clicks, flings, deep presses).

import type { MessageInitShape } from "@bufbuild/protobuf";
import { EgoTouchError } from "../errors.js";
import type { CancelReason, EventType, Finger, Handedness, Surface } from "../events.js";
import type { TouchEventSchema } from "../gen/egotouch/v1/egotouch_pb.js";
import { CANCEL_REASONS, EVENT_TYPES, FINGERS, HANDS, SURFACES } from "../wire/enums.js";

export type WireEvent = MessageInitShape<typeof TouchEventSchema>;

export interface FingerSettings {
  readonly finger?: Finger;
  readonly hand?: Handedness;
  readonly surface?: Surface;
  readonly pitchRad?: number;
  readonly yawRad?: number;
}

/** Defaults of the engine's `GestureConfig`. */
export const TOUCH_SLOP_MM = 5;
export const LONG_PRESS_MS = 400;
export const FORCE_ENTER_N = 1.5;
export const FORCE_EXIT_N = 1.2;
/** A thirtieth of a second, as a camera's. */
export const FRAME_MS = 1000 / 30;

interface Contact {
  readonly downNs: bigint;
  readonly xMm: number;
  readonly yMm: number;
  isDragging: boolean;
  isPressing: boolean;
  wasLong: boolean;
}

/** Where the events of one frame go; `advance` lets the time of a frame pass and gives the new capture time. */
export interface Stage {
  advance(ms: number): bigint;
  publish(events: WireEvent[], timestampNs: bigint): void;
}

export class FakeFinger {
  readonly #stage: Stage;
  readonly #settings: FingerSettings;
  readonly pointerId: number;
  #contactId = 0;
  #contact: Contact | null = null;
  #isNear = false;
  #xMm = 0;
  #yMm = 0;
  #forceN = 0;

  constructor(stage: Stage, pointerId: number, settings: FingerSettings) {
    this.#stage = stage;
    this.pointerId = pointerId;
    this.#settings = settings;
  }

  /** The finger hovers over a place for one frame. */
  hover(xMm: number, yMm: number): this {
    if (this.#contact) throw new EgoTouchError("config", "a finger that is down cannot hover", "Lift it first: up()");
    return this.#frame(xMm, yMm, 0, () => (this.#isNear ? ["hover_move"] : ["hover_enter"]));
  }

  /** It meets the skin where it hovers. */
  down(forceN = 1): this {
    if (!this.#isNear) this.hover(this.#xMm, this.#yMm);
    if (this.#contact) throw new EgoTouchError("config", "the finger is down already", "Lift it first: up()");
    return this.#frame(this.#xMm, this.#yMm, forceN, (timestampNs) => {
      this.#contactId += 1;
      this.#contact = { downNs: timestampNs, xMm: this.#xMm, yMm: this.#yMm, isDragging: false, isPressing: forceN >= FORCE_ENTER_N, wasLong: false };
      return this.#contact.isPressing ? ["down", "force_enter"] : ["down"];
    });
  }

  /** It is on the skin for another frame, perhaps at another place or with another force. */
  move(xMm = this.#xMm, yMm = this.#yMm, forceN = this.#forceN): this {
    const contact = this.#touching();
    return this.#frame(xMm, yMm, forceN, (timestampNs) => this.#moved(contact, timestampNs));
  }

  /** It lifts. */
  up(): this {
    const contact = this.#touching();
    return this.#frame(this.#xMm, this.#yMm, 0, () => {
      const types: EventType[] = [...this.#ending(contact), "up"];
      if (!contact.isDragging) types.push("click");
      return types;
    });
  }

  /** It is lost while touching or hovering, as when the hand leaves the picture. */
  lose(reason: CancelReason = "tracking_lost"): void {
    if (!this.#isNear) return;
    const contact = this.#contact;
    const types: EventType[] = contact ? [...this.#ending(contact), "cancel"] : [];
    this.#frame(this.#xMm, this.#yMm, 0, () => [...types, "hover_exit"], reason);
    this.#isNear = false;
  }

  /** It goes away; while touching it lifts first. */
  leave(): void {
    if (this.#contact) this.up();
    this.lose();
  }

  /** Hover, touch and lift at one place. */
  tap(xMm: number, yMm: number, forceN = 1): this {
    return this.hover(xMm, yMm).down(forceN).move().up();
  }

  /** Touch one place for some time, then lift. */
  press(xMm: number, yMm: number, { durationMs = 600, forceN = 1 } = {}): this {
    this.hover(xMm, yMm).down(forceN);
    for (let ms = 0; ms < durationMs; ms += FRAME_MS) this.move();
    return this.up();
  }

  /** Touch one place, go to another in some frames, and lift. */
  drag([fromX, fromY]: readonly [number, number], [toX, toY]: readonly [number, number], { frames = 10, forceN = 1 } = {}): this {
    this.hover(fromX, fromY).down(forceN);
    for (let i = 1; i <= frames; i += 1) this.move(fromX + ((toX - fromX) * i) / frames, fromY + ((toY - fromY) * i) / frames);
    return this.up();
  }

  #touching(): Contact {
    if (!this.#contact) throw new EgoTouchError("config", "the finger is not down", "Put it down first: down()");
    return this.#contact;
  }

  #moved(contact: Contact, timestampNs: bigint): EventType[] {
    const types: EventType[] = ["move"];
    const wasDragging = contact.isDragging;
    contact.isDragging ||= Math.hypot(this.#xMm - contact.xMm, this.#yMm - contact.yMm) > TOUCH_SLOP_MM;
    if (contact.isDragging) types.push(wasDragging ? "drag" : "drag_start");
    if (!contact.isPressing && this.#forceN >= FORCE_ENTER_N) types.push("force_enter");
    if (contact.isPressing && this.#forceN < FORCE_EXIT_N) types.push("force_exit");
    contact.isPressing = types.includes("force_enter") || (contact.isPressing && !types.includes("force_exit"));
    if (!contact.isDragging && !contact.wasLong && Number(timestampNs - contact.downNs) / 1e6 >= LONG_PRESS_MS) {
      types.push("long_click");
      contact.wasLong = true;
    }
    return types;
  }

  #ending(contact: Contact): EventType[] {
    return [...(contact.isDragging ? (["drag_end"] as const) : []), ...(contact.isPressing ? (["force_exit"] as const) : [])];
  }

  #frame(xMm: number, yMm: number, forceN: number, happens: (timestampNs: bigint) => EventType[], reason?: CancelReason): this {
    const timestampNs = this.#stage.advance(FRAME_MS);
    [this.#xMm, this.#yMm, this.#forceN] = [xMm, yMm, forceN];
    const types = happens(timestampNs);
    const events = types.map((type) => this.#event(type, timestampNs, reason));
    this.#isNear = true;
    if (types.includes("up") || types.includes("cancel")) this.#contact = null;
    this.#stage.publish(events, timestampNs);
    return this;
  }

  #event(type: EventType, timestampNs: bigint, reason?: CancelReason): WireEvent {
    const { finger = "index", hand = "right", surface = "palm", pitchRad = Math.PI / 4, yawRad = 0 } = this.#settings;
    const contact = type.startsWith("hover") ? null : this.#contact;
    return {
      type: EVENT_TYPES.number(type),
      pointerId: this.pointerId,
      contactId: this.#contactId,
      timestampNs,
      ...(contact ? { downTimeNs: contact.downNs, dxMm: this.#xMm - contact.xMm, dyMm: this.#yMm - contact.yMm } : {}),
      hand: HANDS.number(hand),
      finger: FINGERS.number(finger),
      surface: SURFACES.number(surface),
      touchProbability: contact && this.#forceN > 0 ? 0.95 : 0.05,
      forceN: this.#forceN,
      xMm: this.#xMm,
      yMm: this.#yMm,
      pitchRad,
      yawRad,
      imageX: 0.5,
      imageY: 0.5,
      clickCount: type === "click" ? 1 : 0,
      reason: reason && ["cancel", "drag_end", "force_exit"].includes(type) ? CANCEL_REASONS.number(reason) : 0,
    };
  }
}
