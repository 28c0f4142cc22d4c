// A client on a fake server, and all that its app hears.

import { EgoTouchClient, type ClientOptions, type ErrorEvent, type TouchBatch, type TouchEvent } from "../../src/index.js";
import { FakeServer } from "../../src/testing/index.js";

export interface Heard {
  readonly server: FakeServer;
  readonly client: EgoTouchClient;
  readonly events: TouchEvent[];
  readonly batches: TouchBatch[];
  readonly states: string[];
  readonly errors: ErrorEvent[];
  /** Types of the events since the last call; `*` marks local ones. */
  types(): string[];
}

/** A live client on a new server; `hear` keeps what it is told. */
export function connected(options: ClientOptions = {}, server = new FakeServer()): Heard {
  const client = new EgoTouchClient(server.options(options));
  const heard = listenTo(client, server);
  server.connect(client);
  return heard;
}

export function listenTo(client: EgoTouchClient, server: FakeServer): Heard {
  const events: TouchEvent[] = [];
  const batches: TouchBatch[] = [];
  const states: string[] = [];
  const errors: ErrorEvent[] = [];
  let told = 0;
  client.onBatch((batch) => {
    batches.push(batch);
    events.push(...batch.events);
  });
  client.onState(({ state }) => void states.push(state));
  client.onError((error) => void errors.push(error));
  const types = () => {
    const news = events.slice(told).map(({ type, local }) => (local ? `${type}*` : type));
    told = events.length;
    return news;
  };
  return { server, client, events, batches, states, errors, types };
}
