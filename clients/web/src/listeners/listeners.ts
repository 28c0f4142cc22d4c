// Listener registration by name, as Android developers know it; `TouchListener` says when each is called.

import { EgoTouchError } from "../errors.js";
import type { TouchEvent } from "../events.js";
import { accepting, type EventFilter } from "./filters.js";
import { Registry, type Subscription } from "./registry.js";
import { LISTENER_NAMES, type TouchListener } from "./touch_listener.js";

export type Listener<T> = (value: T) => void;

export class Listeners {
  protected readonly registry = new Registry();
  #raw: Subscription | null = null;

  onTouchDown(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onTouchDown", listener, filter);
  }

  onTouchUp(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onTouchUp", listener, filter);
  }

  onTouchMove(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onTouchMove", listener, filter);
  }

  onTouchCancel(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onTouchCancel", listener, filter);
  }

  onDragStart(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onDragStart", listener, filter);
  }

  onDrag(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onDrag", listener, filter);
  }

  onDragEnd(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onDragEnd", listener, filter);
  }

  onClick(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onClick", listener, filter);
  }

  onDoubleClick(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onDoubleClick", listener, filter);
  }

  /** A listener that returns true keeps this contact from becoming a click, for all listeners. */
  onLongClick(listener: (event: TouchEvent) => boolean | void, filter: EventFilter = {}): Subscription {
    return this.#on("onLongClick", listener, filter);
  }

  onForce(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onForce", listener, filter);
  }

  onFling(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onFling", listener, filter);
  }

  onHoverEnter(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onHoverEnter", listener, filter);
  }

  onHoverMove(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onHoverMove", listener, filter);
  }

  onHoverExit(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onHoverExit", listener, filter);
  }

  /** Events that came too late to act on, for logs; only where `subscribe` has `lateEdges`. */
  onLate(listener: Listener<TouchEvent>, filter: EventFilter = {}): Subscription {
    return this.#on("onLate", listener, filter);
  }

  /** Add every method of an object; names that differ from a listener's only in their capitals are refused. */
  addListener(listener: TouchListener, filter: EventFilter = {}): Subscription {
    const known = new Map(LISTENER_NAMES.map((name) => [name.toLowerCase(), name]));
    for (let object: object | null = listener; object && object !== Object.prototype; object = Object.getPrototypeOf(object)) {
      for (const name of Object.getOwnPropertyNames(object)) {
        const right = known.get(name.toLowerCase());
        if (right && right !== name) throw new EgoTouchError("config", `${name} would never be called`, `Name it ${right}`);
      }
    }
    const added = LISTENER_NAMES.filter((name) => listener[name]).map((name) =>
      this.#on(name, (event: TouchEvent) => listener[name]?.(event), filter),
    );
    return together(added);
  }

  /** Let one function hear every `down`, `move`, `up` and `cancel` before all other listeners; replaces the one before, null removes it. */
  setOnTouchListener(listener: Listener<TouchEvent> | null): void {
    this.#raw?.remove();
    this.#raw = listener && this.registry.add("onTouch", listener);
  }

  #on(name: keyof TouchListener, listener: (event: TouchEvent) => unknown, filter: EventFilter): Subscription {
    return this.registry.add(name, listener, accepting(filter));
  }
}

function together(subscriptions: readonly Subscription[]): Subscription {
  return {
    get isActive() {
      return subscriptions.some((subscription) => subscription.isActive);
    },
    remove: () => subscriptions.forEach((subscription) => subscription.remove()),
  };
}
