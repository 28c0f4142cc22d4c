// A checker of the event grammar, for tests and debugging; the grammar is in the Python package's EVENTS.md. Written down on its own:
// it shares nothing with what it checks. Rules are those that one client can hold: it may meet a pointer in the middle of its life.

import { isStream, type EventType, type TouchEvent } from "../events.js";

/** How fast a touch may move, and the noise allowed on top: the defaults of the Python package's `StateConfig`. */
const MAX_SPEED_MM_S = 3000;
const SLACK_MM = 20;
/** Coordinates travel as 32-bit floats. */
const ROUNDING_MM = 0.01;

const HOVERING: readonly EventType[] = ["hover_move", "down", "hover_exit"];
const NEXT_FRAME: readonly EventType[] = ["drag_end", "force_exit", "up", "cancel", "move"];
const PRESSED: readonly EventType[] = [...NEXT_FRAME, "long_click"];

/** What may follow each type of event in the same pointer. */
const MAY_FOLLOW: Readonly<Record<EventType, readonly EventType[]>> = {
  hover_enter: HOVERING,
  hover_move: HOVERING,
  down: [...NEXT_FRAME, "force_enter"],
  move: [...PRESSED, "drag_start", "drag", "force_enter", "force_change"],
  drag_start: [...NEXT_FRAME, "force_enter", "force_change"],
  drag: [...NEXT_FRAME, "force_enter", "force_change"],
  force_enter: PRESSED,
  force_change: PRESSED,
  force_exit: PRESSED,
  long_click: NEXT_FRAME,
  drag_end: ["force_exit", "up", "cancel"],
  up: [...HOVERING, "click", "fling"],
  cancel: HOVERING,
  click: [...HOVERING, "double_click"],
  double_click: HOVERING,
  fling: HOVERING,
  hover_exit: [],
};
const AFTER_UP: ReadonlySet<EventType> = new Set(["click", "double_click", "fling"]);
const HOVERS: ReadonlySet<EventType> = new Set(["hover_enter", "hover_move", "hover_exit"]);

/** One broken rule, and the event that broke it; null when the stream ended too early. */
export interface Violation {
  readonly rule: string;
  readonly event: TouchEvent | null;
}

interface Track {
  last: TouchEvent;
  /** The `down` of the contact that is or was last open. */
  down: TouchEvent | null;
  isDown: boolean;
  isDragging: boolean;
  isPressing: boolean;
  wasDragged: boolean;
  wasLong: boolean;
}

export class GrammarVerifier {
  readonly violations: Violation[] = [];
  readonly #isWhole: boolean;
  #tracks = new Map<number, Track>();
  #isReplay = false;

  /** `isWhole`: all types of events are there. Of a part of them only the brackets are checked. */
  constructor(isWhole = true) {
    this.#isWhole = isWhole;
  }

  /** Edges that were missed follow, without the moves between them. */
  resume(): void {
    this.#isReplay = true;
  }

  /** Check events in their order; gives the rules they break. */
  feed(events: Iterable<TouchEvent>): readonly Violation[] {
    const found: Violation[] = [];
    for (const event of events) {
      if (isStream(event.type)) this.#isReplay = false;
      for (const rule of this.#check(event)) found.push({ rule: `pointer ${event.pointerId}: ${rule}`, event });
    }
    this.violations.push(...found);
    return found;
  }

  /** Check that nothing was left open at the end. */
  close(): readonly Violation[] {
    const found = [...this.#tracks].map(([id, { last }]) => ({ rule: `pointer ${id}: was left open after ${last.type}`, event: null }));
    this.#tracks.clear();
    this.violations.push(...found);
    return found;
  }

  *#check(event: TouchEvent): Generator<string> {
    let track = this.#tracks.get(event.pointerId);
    if (!track) {
      if (event.type !== "hover_enter") yield `begins with ${event.type}`;
      for (const { last } of this.#tracks.values()) {
        if (last.hand === event.hand && last.finger === event.finger) yield `the ${event.hand} ${event.finger} already is pointer ${last.pointerId}`;
      }
      track = { last: event, down: null, isDown: false, isDragging: false, isPressing: false, wasDragged: false, wasLong: false };
      this.#tracks.set(event.pointerId, track);
    } else {
      if (this.#isWhole && !this.#isReplay && !MAY_FOLLOW[track.last.type].includes(event.type)) yield `${event.type} after ${track.last.type}`;
      yield* this.#checkPointer(track, event);
    }
    yield* checkBrackets(track, event);
    if (event.type === "down") Object.assign(track, { down: event, isDown: true, wasDragged: false, wasLong: false });
    else if (!HOVERS.has(event.type)) yield* this.#checkContact(track, event);
    track.last = event;
    if (event.type === "hover_exit") this.#tracks.delete(event.pointerId);
  }

  *#checkPointer({ last }: Track, event: TouchEvent): Generator<string> {
    if (event.timestampNs < last.timestampNs) yield `time goes back from ${last.timestampNs} to ${event.timestampNs} ns at ${event.type}`;
    if (event.hand !== last.hand || event.finger !== last.finger) yield `changes to the ${event.hand} ${event.finger} at ${event.type}`;
    const rises = event.contactId > last.contactId;
    if (event.type === "down" ? !rises : event.contactId < last.contactId || (rises && !HOVERS.has(event.type))) {
      yield `contact id goes from ${last.contactId} to ${event.contactId} on ${event.type}`;
    }
    if (this.#isWhole && last.clickCount === 2 && last.type === "click" && event.type !== "double_click") yield `click 2 is followed by ${event.type}`;
  }

  *#checkContact(track: Track, event: TouchEvent): Generator<string> {
    const { down, last } = track;
    if (!down) return;
    if (event.downTimeNs !== down.timestampNs) yield `${event.type} speaks of a down at ${event.downTimeNs}, it was at ${down.timestampNs}`;
    if (event.forceN > 0 && (AFTER_UP.has(event.type) || event.type === "up" || event.type === "cancel")) yield `${event.type} has a force`;
    if (Math.hypot(event.xMm - event.dxMm - down.xMm, event.yMm - event.dyMm - down.yMm) > ROUNDING_MM) yield `${event.type} is not where its way says`;
    const wayMm = Math.hypot(event.xMm - last.xMm, event.yMm - last.yMm);
    const elapsedS = Number(event.timestampNs - last.timestampNs) / 1e9;
    if (wayMm > MAX_SPEED_MM_S * elapsedS + SLACK_MM + ROUNDING_MM) yield `${event.type} jumps ${wayMm.toFixed(0)} mm`;
  }
}

/** What opens and closes: contacts, drags, force presses, and what a lift means. */
function* checkBrackets(track: Track, event: TouchEvent): Generator<string> {
  const { type } = event;
  if (HOVERS.has(type) || type === "down") {
    if (track.isDown) yield `${type} while down`;
    track.isDown = track.isDragging = track.isPressing = false;
    return;
  }
  if (AFTER_UP.has(type)) {
    if (track.isDown) yield `${type} while down`;
    if (type === "fling" ? !track.wasDragged : track.wasDragged) yield `${type} ${track.wasDragged ? "after" : "without"} a drag`;
    if (type === "double_click" && event.clickCount !== 2) yield `double_click has click count ${event.clickCount}`;
    return;
  }
  if (!track.isDown) yield `${type} while not down`;
  if (type === "drag_start") {
    if (track.wasDragged) yield "second drag in one contact";
    track.isDragging = track.wasDragged = true;
  } else if (type === "drag" || type === "drag_end") {
    if (!track.isDragging) yield `${type} outside of a drag`;
    if (type === "drag_end") track.isDragging = false;
  } else if (type === "force_enter") {
    if (track.isPressing) yield "force_enter inside of a force press";
    track.isPressing = true;
  } else if (type === "force_change" || type === "force_exit") {
    if (!track.isPressing) yield `${type} outside of a force press`;
    if (type === "force_exit") track.isPressing = false;
  } else if (type === "long_click") {
    if (track.wasDragged || track.wasLong) yield `long_click ${track.wasDragged ? "in a drag" : "for the second time"}`;
    track.wasLong = true;
  } else if (type === "up" || type === "cancel") {
    if (track.isDragging || track.isPressing) yield `${type} before ${track.isDragging ? "drag_end" : "force_exit"}`;
    track.isDown = track.isDragging = track.isPressing = false;
  }
}
