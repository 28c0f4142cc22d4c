// Forces of all fingers that touch: as lines of a plot and as text.

import type { TouchEvent } from "../../src/index.js";
import type { Plot } from "./plot.js";
import { FINGER_COLOURS, words } from "./vocabulary.js";

export class ForceRecord {
  readonly #plot: Plot;
  readonly #touching = new Map<number, TouchEvent>();

  constructor(plot: Plot) {
    this.#plot = plot;
  }

  /** The forces now, with the finger's name where there are several. */
  get text(): string {
    const events = [...this.#touching.values()];
    const newtons = ({ forceN }: TouchEvent) => `${forceN.toFixed(2)} N`;
    return events.length === 1 ? newtons(events[0]!) : events.map((event) => `${words(event.finger)} ${newtons(event)}`).join(" · ");
  }

  /** Take one event at `now` (milliseconds of this page's clock). */
  take(event: TouchEvent, now: number): void {
    const touches = event.type === "down" || event.type === "move";
    if (!touches && event.type !== "up" && event.type !== "cancel") return;
    if (touches) this.#touching.set(event.pointerId, event);
    else this.#touching.delete(event.pointerId);
    this.#plot.add(event.pointerId, FINGER_COLOURS[event.finger], now, touches ? event.forceN : null);
  }
}
