import type { EgoTouchClient } from "../client.js";
import { EgoTouchError } from "../errors.js";
import type { TouchEvent } from "../events.js";
import { accepting, type EventFilter } from "../listeners/filters.js";
import type { Subscription } from "../listeners/registry.js";
import { own } from "./capture.js";
import { placeOn, type PlaceMap, type ScreenPoint, type SkinArea } from "./place.js";
import { DomPointer } from "./pointer.js";

/** "ET" in the upper half: far from the ids that browsers give. */
const FIRST_ID = 0x45540000;
const ID_MASK = 0xffff;

export interface PointerOptions {
  readonly client: EgoTouchClient;
  /** Where a touch is on the screen; by default `area` lies over the root's box. */
  readonly map?: PlaceMap;
  /** The rectangle of skin that lies over the root's box; by default the palm. */
  readonly area?: SkinArea;
  /** Which fingers, hands and surfaces. */
  readonly filter?: EventFilter;
}

/**
 * Make skin touches real DOM PointerEvents of the elements under `root`: boundary events, capture, coalesced events, `click`, `dblclick`,
 * and `contextmenu` on a long click (preventing its default keeps the contact from clicking). Ends with `remove()`, which cancels what
 * is down. The events are synthetic: they activate links, buttons and checkboxes, but are not `isTrusted` (no full screen, no pop-ups),
 * start no scrolling and set no `:hover`.
 */
export function attachPointerEvents(root: Element, options: PointerOptions): Subscription {
  if (!(root instanceof Element)) throw new EgoTouchError("config", "attachPointerEvents got no element", "Pass one, such as document.body");
  const { client } = options;
  const accepts = accepting(options.filter ?? {});
  const map = options.map ?? placeOn(root, options.area);
  const pointers = new Map<number, DomPointer>();
  const hit = (point: ScreenPoint) => elementAt(root, point);
  const withId = (id: number) => [...pointers.values()].find((pointer) => pointer.id === id);

  /** The pointer of an event outside of a contact, or of one that begins a contact; a contact is followed wherever it goes. */
  const wanted = (event: TouchEvent): DomPointer | null => {
    if (!accepts(event)) {
      leave(event);
      return null;
    }
    let pointer = pointers.get(event.pointerId);
    if (!pointer) {
      pointer = new DomPointer(FIRST_ID + (event.pointerId & ID_MASK), pointers.size === 0, event, map, hit);
      pointers.set(event.pointerId, pointer);
    }
    return pointer;
  };
  const followed = (event: TouchEvent) => pointers.get(event.pointerId);
  const leave = (event: TouchEvent) => {
    followed(event)?.leave();
    pointers.delete(event.pointerId);
  };

  const disown = own({
    has: (id) => withId(id) !== undefined,
    capture: (id, element) => withId(id)?.capture(element),
    release: (id, element) => withId(id)?.release(element),
    holder: (id) => withId(id)?.holder ?? null,
  });
  const listening = client.addListener({
    onHoverEnter: (event) => wanted(event)?.hover(event),
    onHoverMove: (event) => wanted(event)?.hover(event),
    onTouchDown: (event) => wanted(event)?.down(event),
    onTouchMove: (event) => followed(event)?.move(event),
    onTouchUp: (event) => followed(event)?.up(event),
    onTouchCancel: (event) => followed(event)?.cancel(),
    onClick: (event) => followed(event)?.click("click", event),
    onDoubleClick: (event) => followed(event)?.click("dblclick", event),
    onLongClick: (event) => followed(event)?.contextMenu(event) ?? false,
    onHoverExit: leave,
  });
  return {
    get isActive() {
      return listening.isActive;
    },
    remove: () => {
      listening.remove();
      for (const pointer of pointers.values()) pointer.leave();
      pointers.clear();
      disown();
    },
  };
}

/** The innermost element under `root` at a point, in shadow trees too; null where there is none. */
function elementAt(root: Element, { x, y }: ScreenPoint): Element | null {
  let found = document.elementFromPoint(x, y);
  for (let inner: Element | null = found; inner?.shadowRoot; ) {
    inner = inner.shadowRoot.elementFromPoint(x, y);
    if (!inner || inner === found) break;
    found = inner;
  }
  for (let node: Node | null = found; node; node = node instanceof ShadowRoot ? node.host : node.parentNode) if (node === root) return found;
  return null;
}
