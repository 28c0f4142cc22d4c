// Listeners of the connection and of what the server says about itself.

import type { ConnectionState } from "../core/effects.js";
import type { TouchBatch } from "../events.js";
import type { HandsView, Status, Warning, Welcome } from "../gen/egotouch/v1/egotouch_pb.js";
import { Listeners, type Listener } from "./listeners.js";
import type { Subscription } from "./registry.js";
import type { ErrorEvent, TrackingState } from "./touch_listener.js";

/** What the connection is, with one sentence for the user. */
export interface StateEvent {
  readonly state: ConnectionState;
  readonly detail: string;
}

export abstract class ConnectionListeners extends Listeners {
  /** All events of one camera frame together, late and local ones too; see their marks. */
  onBatch(listener: Listener<TouchBatch>): Subscription {
    return this.registry.add("onBatch", listener);
  }

  onState(listener: Listener<StateEvent>): Subscription {
    return this.registry.add("onState", listener);
  }

  onWelcome(listener: Listener<Welcome>): Subscription {
    return this.registry.add("onWelcome", listener);
  }

  /** The server's own figures, about once a second. */
  onStatus(listener: Listener<Status>): Subscription {
    this.wantStatus();
    return this.registry.add("onStatus", listener);
  }

  /** Other hands are seen than before, or the gate has opened or closed. */
  onTrackingChanged(listener: Listener<TrackingState>): Subscription {
    this.wantStatus();
    return this.registry.add("onTrackingChanged", listener);
  }

  /** Landmarks of the hands in view, where `subscribe` asks for `landmarks` and the server allows it. */
  onHands(listener: Listener<HandsView>): Subscription {
    return this.registry.add("onHands", listener);
  }

  onWarning(listener: Listener<Warning>): Subscription {
    return this.registry.add("onWarning", listener);
  }

  /** The server wants a token or a pairing code: get one, then call `start({ token })` or `start({ pairingCode })`. */
  onAccessWanted(listener: Listener<string>): Subscription {
    return this.registry.add("onAccessWanted", listener);
  }

  /** The token that a pairing code was exchanged for; keep it for the next start. */
  onToken(listener: Listener<string>): Subscription {
    return this.registry.add("onToken", listener);
  }

  /** A listener has thrown, the server sent nonsense, or (with `debug`) the event grammar was broken. */
  onError(listener: Listener<ErrorEvent>): Subscription {
    return this.registry.add("onError", listener);
  }

  /** Somebody wants the server's Status, which comes only when it is asked for. */
  protected abstract wantStatus(): void;
}
