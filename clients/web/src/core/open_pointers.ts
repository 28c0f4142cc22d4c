// Which pointers and contacts are open at this client. What ended here stays ended: later events of the same contact are dropped until
// its pointer's next `down`, so that nothing sticks, nothing clicks late, and every `down` that an app hears gets one `up` or `cancel`.

import { isStream, type EventType, type TouchEvent } from "../events.js";

const OPENS: ReadonlySet<EventType> = new Set(["hover_enter", "hover_move", "down"]);
const AFTER_UP: ReadonlySet<EventType> = new Set(["click", "double_click", "fling"]);
const HOVERS: ReadonlySet<EventType> = new Set(["hover_enter", "hover_move", "hover_exit"]);

/** A pointer that is open here. */
interface Pointer {
  last: TouchEvent;
  /** The contact that is down; 0 when none is. */
  contactId: number;
  /** The contact that was lifted last, which may still click. */
  liftedId: number;
  isDragging: boolean;
  isPressing: boolean;
}

/** What Resume says of an open pointer. */
export interface Held {
  readonly pointerId: number;
  readonly contactId: number;
  readonly dragging: boolean;
  readonly pressing: boolean;
}

const STILL = { forceN: 0, forceSigmaN: null, clickCount: 0, reason: null, coalesced: [], latencyMs: null, local: true } as const;
const HOVERING = { downTimeNs: null, dxMm: 0, dyMm: 0, velocityXMmS: 0, velocityYMmS: 0 } as const;

export class OpenPointers {
  #open = new Map<number, Pointer>();
  /** Events that were dropped because their contact had ended here or came too late. */
  dropped = 0;

  /** Number of contacts that are down. */
  get contacts(): number {
    return [...this.#open.values()].filter((pointer) => pointer.contactId > 0).length;
  }

  /** The last events of all open pointers. */
  get events(): readonly TouchEvent[] {
    return [...this.#open.values()].map((pointer) => pointer.last);
  }

  get held(): readonly Held[] {
    return [...this.#open].map(([pointerId, { contactId, isDragging, isPressing }]) => ({
      pointerId, contactId, dragging: contactId > 0 && isDragging, pressing: contactId > 0 && isPressing,
    }));
  }

  /** What an app hears of events from the server. Of `stale` ones the first edge cancels its contact and nothing begins or clicks. */
  apply(events: readonly TouchEvent[], stale = false): TouchEvent[] {
    return events.flatMap((event) => {
      const heard = this.#take(event, stale);
      if (!heard.includes(event)) this.dropped += 1;
      return heard;
    });
  }

  /** End everything: what is due of `drag_end`, `force_exit` and `cancel`, then `hover_exit`, for each pointer. */
  endAll(): TouchEvent[] {
    const ended = [...this.#open.values()].flatMap((pointer) => [
      ...cancelling(pointer, pointer.last),
      { ...pointer.last, ...STILL, ...HOVERING, type: "hover_exit", late: false } as const,
    ]);
    this.#open.clear();
    return ended;
  }

  #take(event: TouchEvent, stale: boolean): TouchEvent[] {
    let pointer = this.#open.get(event.pointerId);
    const before: TouchEvent[] = [];
    if (!pointer) {
      if (!OPENS.has(event.type) || (event.type === "down" && stale)) return [];
      pointer = { last: event, contactId: 0, liftedId: 0, isDragging: false, isPressing: false };
      this.#open.set(event.pointerId, pointer);
      if (event.type === "hover_enter") return [event];
      before.push(entering(event));
      if (event.type === "hover_move") return before;
    }
    if (HOVERS.has(event.type)) return this.#hover(pointer, event);
    if (event.type === "down") return [...before, ...this.#down(pointer, event, stale)];
    return this.#contact(pointer, event, stale);
  }

  #hover(pointer: Pointer, event: TouchEvent): TouchEvent[] {
    const cancelled = cancelling(pointer, event); // a server that forgot to lift: never leave the contact down
    pointer.last = event;
    pointer.contactId = 0;
    if (event.type === "hover_exit") this.#open.delete(event.pointerId);
    return [...cancelled, event];
  }

  #down(pointer: Pointer, event: TouchEvent, stale: boolean): TouchEvent[] {
    const cancelled = cancelling(pointer, event);
    pointer.contactId = pointer.liftedId = 0;
    if (stale) return cancelled;
    Object.assign(pointer, { last: event, contactId: event.contactId, isDragging: false, isPressing: false });
    return [...cancelled, event];
  }

  #contact(pointer: Pointer, event: TouchEvent, stale: boolean): TouchEvent[] {
    if (AFTER_UP.has(event.type)) {
      if (stale || pointer.contactId > 0 || pointer.liftedId !== event.contactId) return [];
      pointer.last = event;
      return [event];
    }
    if (pointer.contactId !== event.contactId || pointer.contactId === 0) return [];
    if (stale && !isStream(event.type)) {
      const cancelled = cancelling(pointer, event);
      pointer.last = cancelled.at(-1) ?? event;
      pointer.contactId = 0;
      return cancelled;
    }
    pointer.last = event;
    if (event.type === "drag_start" || event.type === "drag_end") pointer.isDragging = event.type === "drag_start";
    if (event.type === "force_enter" || event.type === "force_exit") pointer.isPressing = event.type === "force_enter";
    if (event.type === "up" || event.type === "cancel") {
      pointer.contactId = 0;
      pointer.liftedId = event.type === "up" ? event.contactId : 0;
    }
    return [event];
  }
}

/** How a contact ends by this client, placed and timed as `at`; nothing when none is down. */
function cancelling(pointer: Pointer, at: TouchEvent): TouchEvent[] {
  if (pointer.contactId === 0) return [];
  const types: EventType[] = ["cancel"];
  if (pointer.isPressing) types.unshift("force_exit");
  if (pointer.isDragging) types.unshift("drag_end");
  const { contactId, last } = pointer;
  const { downTimeNs } = last;
  return types.map((type) => ({ ...at, ...STILL, type, contactId, downTimeNs, reason: "disconnected", late: last.late }));
}

/** The `hover_enter` with which an app learns of a pointer that was there before. */
function entering(event: TouchEvent): TouchEvent {
  const contactId = event.contactId - (event.type === "down" ? 1 : 0);
  return { ...event, ...HOVERING, type: "hover_enter", contactId, forceN: 0, coalesced: [] };
}
