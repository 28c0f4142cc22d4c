// One skin finger as a DOM pointer: which element it is over, who has captured it, and the events that follow from both, in the order
// of Pointer Events Level 3.

import type { TouchEvent } from "../events.js";
import { azimuthOf, type PlaceMap, type ScreenPoint } from "./place.js";

/** Full scale of `pressure`, in newtons: the range of the touch model. */
const FORCE_MAX_N = 3.5;
const FINGERS = ["thumb", "index", "middle", "ring", "pinky"];

export class DomPointer {
  readonly id: number;
  readonly #isPrimary: boolean;
  readonly #map: PlaceMap;
  readonly #hit: (point: ScreenPoint) => Element | null;
  #last: TouchEvent;
  #point: ScreenPoint = { x: 0, y: 0 };
  /** The element that boundary events say the pointer is over, and those around it when they said so. */
  #over: readonly Element[] = [];
  #isDown = false;
  #downTarget: Element | null = null;
  #upTarget: Element | null = null;
  #captured: Element | null = null;
  #pending: Element | null = null;

  constructor(id: number, isPrimary: boolean, first: TouchEvent, map: PlaceMap, hit: (point: ScreenPoint) => Element | null) {
    this.id = id;
    this.#isPrimary = isPrimary;
    this.#last = first;
    this.#map = map;
    this.#hit = hit;
  }

  /** The element that has, or is about to get, the capture. */
  get holder(): Element | null {
    return this.#pending;
  }

  capture(element: Element): void {
    if (this.#isDown) this.#pending = element;
  }

  release(element: Element): void {
    if (this.#pending === element) this.#pending = null;
  }

  /** The finger hovers. */
  hover(event: TouchEvent): void {
    this.#take(event);
    this.#send("pointermove", this.#reach());
  }

  down(event: TouchEvent): void {
    this.#take(event);
    const target = this.#reach();
    this.#isDown = true;
    this.#downTarget = this.#upTarget = target;
    if (!target) return;
    this.#pending = target; // implicit capture, as of every touch
    this.#send("pointerdown", target);
  }

  move(event: TouchEvent): void {
    this.#take(event);
    this.#send("pointermove", this.#reach());
  }

  up(event: TouchEvent): void {
    this.#take(event);
    const target = this.#reach();
    this.#upTarget = this.#hit(this.#point);
    this.#isDown = false;
    this.#send("pointerup", target);
    this.#pending = null;
    this.#settleCapture();
  }

  /** The touch ended without a lift: `pointercancel` repeats the last event's fields. */
  cancel(): void {
    this.#settleCapture();
    const target = this.#captured ?? this.#from();
    this.#isDown = false;
    this.#upTarget = this.#downTarget = null;
    this.#send("pointercancel", target);
    this.#pending = null;
    this.#settleCapture();
    this.#moveOver(null);
  }

  /** The finger is gone. */
  leave(): void {
    if (this.#isDown) this.cancel();
    this.#moveOver(null);
  }

  /** `click` or `dblclick` on what the finger landed on and lifted from. */
  click(type: "click" | "dblclick", event: TouchEvent): void {
    const target = commonAncestor(this.#downTarget, this.#upTarget);
    if (!target?.isConnected) return;
    this.#last = event;
    if (type === "click") focusNear(target);
    this.#dispatch(type, target, { cancelable: true, button: 0, detail: event.clickCount });
  }

  /** A long press; true when a listener prevented the default, and thereby the click. */
  contextMenu(event: TouchEvent): boolean {
    this.#last = event;
    const target = this.#hit(this.#point) ?? this.#downTarget;
    return target !== null && !this.#dispatch("contextmenu", target, { cancelable: true, button: 2, buttons: 0 });
  }

  #take(event: TouchEvent): void {
    this.#last = event;
    this.#point = this.#map(event) ?? (this.#isDown ? this.#point : OFF_SCREEN);
  }

  /** Settle capture and boundary events for the present place; gives the element that hears of it. */
  #reach(): Element | null {
    this.#settleCapture();
    const target = this.#captured ?? this.#hit(this.#point);
    this.#moveOver(target);
    return target;
  }

  #settleCapture(): void {
    if (this.#captured && !this.#captured.isConnected) this.#captured = null; // removed from the document: it hears nothing any more
    if (this.#pending && !this.#pending.isConnected) this.#pending = null;
    if (this.#pending === this.#captured) return;
    const [old, next] = [this.#captured, this.#pending];
    this.#captured = next;
    if (old) this.#dispatch("lostpointercapture", old, {});
    if (next) this.#dispatch("gotpointercapture", next, {});
  }

  /** Boundary events from the element that the pointer was over to the one that it is over. */
  #moveOver(target: Element | null): void {
    const from = this.#from();
    const [left, entered] = [path(from), path(target)];
    this.#over = entered;
    if (from === target) return;
    if (from) {
      this.#dispatch("pointerout", from, { cancelable: true, relatedTarget: target });
      for (const element of left) if (!entered.includes(element)) this.#dispatch("pointerleave", element, { bubbles: false, composed: false, relatedTarget: target });
    }
    if (target) {
      this.#dispatch("pointerover", target, { cancelable: true, relatedTarget: from });
      for (const element of [...entered].reverse()) if (!left.includes(element)) this.#dispatch("pointerenter", element, { bubbles: false, composed: false, relatedTarget: from });
    }
  }

  /** Where the pointer was: what has been taken out of the document leaves its place to what was around it. */
  #from(): Element | null {
    return this.#over.find((element) => element.isConnected) ?? null;
  }

  #send(type: "pointerdown" | "pointermove" | "pointerup" | "pointercancel", target: Element | null): void {
    if (!target) return;
    const changed = type === "pointerdown" || type === "pointerup" ? 0 : -1;
    this.#dispatch(type, target, {
      cancelable: type !== "pointercancel",
      button: changed,
      coalescedEvents: type === "pointermove" ? this.#samples(target) : [],
    });
  }

  /** The merged events and this one, oldest first. Browsers give a target to those of trusted events only. */
  #samples(target: Element): PointerEvent[] {
    return [...this.#last.coalesced, this.#last].map((event) => {
      const sample = new PointerEvent("pointermove", this.#init(event, this.#map(event) ?? this.#point, {}));
      return Object.defineProperty(sample, "target", { value: target });
    });
  }

  #dispatch(type: string, target: Element, init: PointerEventInit): boolean {
    return target.dispatchEvent(new PointerEvent(type, this.#init(this.#last, this.#point, init)));
  }

  #init(event: TouchEvent, { x, y }: ScreenPoint, more: PointerEventInit): PointerEventInit {
    return {
      bubbles: true,
      composed: true,
      view: window,
      clientX: x,
      clientY: y,
      screenX: x + window.screenX,
      screenY: y + window.screenY,
      pointerId: this.id,
      pointerType: "touch",
      isPrimary: this.#isPrimary,
      pressure: this.#isDown ? Math.min(event.forceN / FORCE_MAX_N, 1) : 0,
      altitudeAngle: event.pitchRad,
      azimuthAngle: azimuthOf(event, this.#map),
      persistentDeviceId: (event.hand === "right" ? 8 : 0) + FINGERS.indexOf(event.finger) + 1,
      button: -1,
      buttons: this.#isDown ? 1 : 0,
      ...more,
    } as PointerEventInit;
  }
}

/** A place that no element is at. */
const OFF_SCREEN: ScreenPoint = { x: -1e6, y: -1e6 };

/** The element and those around it, innermost first, out of shadow trees too. */
function path(element: Element | null): Element[] {
  const elements: Element[] = [];
  for (let node: Node | null = element; node; node = node instanceof ShadowRoot ? node.host : node.parentNode) {
    if (node instanceof Element) elements.push(node);
  }
  return elements;
}

function commonAncestor(one: Element | null, other: Element | null): Element | null {
  const around = path(other);
  return path(one).find((element) => around.includes(element)) ?? null;
}

/** A click of a user moves the focus; a synthetic one does not. */
function focusNear(target: Element): void {
  const focusable = target.closest<HTMLElement>("a[href], button, input, select, textarea, summary, [tabindex], [contenteditable]");
  focusable?.focus({ preventScroll: true });
}
