// Who listens to what. Listeners may be added and removed at any time, also by themselves while they are called.

import { EgoTouchError } from "../errors.js";
import type { ErrorEvent } from "./touch_listener.js";

/** A registered listener. `remove()` may be called more than once; no call begins after it. */
export interface Subscription {
  readonly isActive: boolean;
  remove(): void;
}

interface Handler {
  readonly call: (value: never) => unknown;
  readonly accepts: (value: never) => boolean;
  isActive: boolean;
}

const ERROR = "onError";
const everything = () => true;

export class Registry {
  #handlers = new Map<string, readonly Handler[]>();
  #reported = new WeakSet<Handler>();

  /** Errors that listeners have thrown so far. */
  errors = 0;

  /** Add one listener; of `accepts` only those values that it is true for reach it. */
  add<T>(name: string, call: (value: T) => unknown, accepts: (value: T) => boolean = everything): Subscription {
    if (typeof call !== "function") throw new EgoTouchError("config", `${name} got ${String(call)}, which cannot be called`, "Give a function");
    const handler: Handler = { call, accepts, isActive: true };
    this.#handlers.set(name, [...this.of(name), handler]);
    return {
      get isActive() {
        return handler.isActive;
      },
      remove: () => {
        handler.isActive = false;
        this.#handlers.set(name, this.of(name).filter((other) => other !== handler));
      },
    };
  }

  /** True when somebody listens to `name`. */
  has(name: string): boolean {
    return this.of(name).length > 0;
  }

  /** Call everyone who listens to `name`, in the order of registration; gives what they returned. Never throws. */
  call<T>(name: string, value: T): unknown[] {
    return this.of(name).map((handler) => this.#call(name, handler, value));
  }

  /** Tell `onError`; what nobody listens to goes to the console. */
  report(event: ErrorEvent): void {
    if (this.has(ERROR)) this.call(ERROR, event);
    else console.error(event.listener ? `${event.listener} has thrown` : "egotouch", event.error);
  }

  private of(name: string): readonly Handler[] {
    return this.#handlers.get(name) ?? [];
  }

  #call<T>(name: string, handler: Handler, value: T): unknown {
    try {
      return handler.isActive && handler.accepts(value as never) ? handler.call(value as never) : undefined;
    } catch (error) {
      this.errors += 1;
      if (name !== ERROR) this.report({ error, listener: name, event: isEvent(value) ? value : null });
      else if (!this.#reported.has(handler)) console.error("onError has thrown", error);
      this.#reported.add(handler);
      return undefined;
    }
  }
}

const isEvent = (value: unknown): value is ErrorEvent["event"] => typeof value === "object" && value !== null && "pointerId" in value;
