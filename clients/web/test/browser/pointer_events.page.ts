// A page whose elements note every pointer event; the test moves a skin finger through `kit`.

import { attachPointerEvents } from "../../src/dom/index.js";
import { EgoTouchClient, type Subscription } from "../../src/index.js";
import { FakeServer } from "../../src/testing/index.js";

const TYPES = [
  "pointerover", "pointerenter", "pointerdown", "pointermove", "pointerup", "pointercancel", "pointerout", "pointerleave",
  "gotpointercapture", "lostpointercapture", "click", "dblclick", "contextmenu",
];
const FIELDS = [
  "pointerId", "pointerType", "isPrimary", "pressure", "buttons", "button", "clientX", "clientY", "altitudeAngle", "azimuthAngle",
  "bubbles", "cancelable", "detail", "isTrusted",
] as const;

const server = new FakeServer();
const client = new EgoTouchClient(server.options());
let log: string[] = [];
let events: PointerEvent[] = [];

for (const element of document.querySelectorAll("[id]")) {
  for (const type of TYPES) {
    element.addEventListener(type, (event) => {
      if (event.eventPhase !== Event.AT_TARGET) return;
      log.push(`${type} ${element.id}`);
      events.push(event as PointerEvent);
    });
  }
}
server.connect(client);
let attached: Subscription;
const attach = (filter = {}) => {
  // One pixel of the screen is one millimetre of skin, from the top left: +y of the skin is upwards.
  attached = attachPointerEvents(document.getElementById("root")!, { client, filter, map: ({ xMm, yMm }) => ({ x: xMm, y: 200 - yMm }) });
};
attach();

const kit = {
  server,
  client,
  finger: server.finger(),
  attach,
  detach: () => attached.remove(),
  /** What has been noted since the last call. */
  take: () => log.splice(0),
  /** Fields of the noted events. */
  fields: (type: string) => events.filter((event) => event.type === type).map((event) => Object.fromEntries(FIELDS.map((field) => [field, event[field]]))),
  last: () => events.at(-1)!,
  forget: () => {
    log = [];
    events = [];
  },
};
export type Kit = typeof kit;
Object.assign(globalThis, { kit });
