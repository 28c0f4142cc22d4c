/** What the keypad does, without a screen: touches in, a number and what to draw out. */
import type { CancelReason, Handedness, Surface, TouchBatch, TouchEvent } from "../../src/events.js";
import { SkinViewGroup, toView, type FingerLook, type KeyPress, type SkinKeypad, type SkinLayout } from "../../src/skin/index.js";

/** Longer than any way within one key, so that what erases never dials. */
const ERASE_MM = 25;
/** Longer than any telephone number (ITU-T E.164 allows 15 digits); what a resting hand could dial ends somewhere. */
const MAX_DIGITS = 24;

/** What happened last; `serial` tells two of a kind apart. */
export interface Note {
  readonly serial: number;
  readonly kind: "key" | "plus" | "erased" | "cancelled" | "full";
  readonly key: string;
  readonly reason: CancelReason | null;
}

export class KeypadModel {
  readonly #layout: SkinLayout;
  readonly #onChange: () => void;
  #group!: SkinViewGroup;
  #surface!: Surface;
  #host: Handedness = "left";
  #number = "";
  #note: Note = { serial: 0, kind: "key", key: "", reason: null };

  /** `layout` has a keypad for each surface and hand that can be chosen. */
  constructor(layout: SkinLayout, onChange: () => void, surface: Surface = "palm") {
    this.#layout = layout;
    this.#onChange = onChange;
    this.choose(surface);
  }

  get number(): string {
    return this.#number;
  }

  get note(): Note {
    return this.#note;
  }

  get surface(): Surface {
    return this.#surface;
  }

  /** The hand whose limb is shown: the chosen one, until the other one is touched. */
  get host(): Handedness {
    return this.#host;
  }

  /** The keypad that is shown. */
  get keypad(): SkinKeypad {
    const keypad = this.#group.layout.keypads.find(({ host }) => host === this.#host);
    if (!keypad) throw new Error(`the layout has no keypad for the ${this.#host} ${this.#surface}`);
    return keypad;
  }

  /** Fingers over or on the limb that is shown. */
  get fingers(): readonly FingerLook[] {
    return this.#group.fingers.filter(({ host }) => host === this.#host);
  }

  look(key: SkinKeypad["keys"][number]): ReturnType<SkinViewGroup["look"]> {
    return this.#group.look(key);
  }

  /** Put the keys on another surface; a touch that lasts is forgotten. */
  choose(surface: Surface, host = this.#host): void {
    const keypads = this.#layout.keypads.filter((keypad) => keypad.surface === surface);
    this.#surface = surface;
    this.#host = host;
    const group = (this.#group = new SkinViewGroup({ keypads, views: keypads.flatMap(({ keys }) => keys) }));
    group.onKey(({ key }) => this.#append(key, "key"));
    group.onLongKey(({ key }) => key === "0" && (this.#append("+", "plus"), true));
    for (const keypad of keypads) {
      for (const { name, key } of keypad.keys) {
        group.on(name, "onDragEnd", (event) => this.#erase({ keypad, key, event }));
        group.on(name, "onTouchCancel", ({ reason }) => this.#tell("cancelled", key, reason));
      }
    }
    this.#onChange();
  }

  clear(): void {
    this.#number = "";
    this.#onChange();
  }

  /** Take in all events of one camera frame. */
  handle(batch: Pick<TouchBatch, "events">): void {
    for (const event of batch.events) {
      if (event.type === "hover_enter") this.#follow(event);
      this.#group.handle(event);
    }
    this.#onChange();
  }

  #follow({ hostHand }: TouchEvent): void {
    if (this.#group.fingers.length === 0) this.#host = hostHand;
  }

  #append(key: string, kind: "key" | "plus"): void {
    if (this.#number.length >= MAX_DIGITS) return this.#tell("full", key);
    this.#number += key;
    this.#tell(kind, key);
  }

  #erase({ keypad, event }: KeyPress): void {
    const [right, up] = toView(keypad.axes, [event.dxMm, event.dyMm]);
    if (event.reason !== null || event.late || right > -Math.max(ERASE_MM, Math.abs(up)) || !this.#number) return;
    const last = this.#number.slice(-1);
    this.#number = this.#number.slice(0, -1);
    this.#tell("erased", last);
  }

  #tell(kind: Note["kind"], key: string, reason: CancelReason | null = null): void {
    this.#note = { serial: this.#note.serial + 1, kind, key, reason };
  }
}
