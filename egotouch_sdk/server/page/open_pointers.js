// Which pointers and contacts are open on this page. What ends here by a local CANCEL stays ended: later events of the same
// contact are dropped until its next DOWN, so nothing can stick and nothing clicks late.

const HOVER = new Set(["HOVER_ENTER", "HOVER_MOVE", "HOVER_EXIT"]);
const AFTER_UP = new Set(["CLICK", "DOUBLE_CLICK", "FLING"]);

const exitOf = (last) => ({ ...last, type: "HOVER_EXIT", force_n: 0, click_count: 0, reason: null, coalesced: [] });

export class OpenPointers {
  #open = new Map(); // pointer_id -> {last: event, touching: boolean}

  /** Number of contacts that are down. */
  get contacts() {
    return [...this.#open.values()].filter((pointer) => pointer.touching).length;
  }

  /** The last events of all open pointers. */
  get events() {
    return [...this.#open.values()].map((pointer) => pointer.last);
  }

  /** Take an event from the server; false when it belongs to a contact that has ended here and must be ignored. */
  accept(event) {
    const pointer = this.#open.get(event.pointer_id);
    if (event.type === "HOVER_EXIT") {
      this.#open.delete(event.pointer_id);
      return pointer !== undefined;
    }
    if (HOVER.has(event.type)) {
      this.#open.set(event.pointer_id, { last: event, touching: false });
      return true;
    }
    if (event.type === "DOWN") {
      this.#open.set(event.pointer_id, { last: event, touching: true });
      return true;
    }
    if (AFTER_UP.has(event.type)) return pointer?.last.contact_id === event.contact_id && pointer.last.type !== "CANCEL";
    if (!pointer?.touching) return false;
    pointer.last = event;
    pointer.touching = event.type !== "UP" && event.type !== "CANCEL";
    return true;
  }

  /** End every contact; gives the CANCEL events to show. The pointers themselves stay until the server says otherwise. */
  cancelContacts(reason = "DISCONNECTED") {
    const touching = [...this.#open.values()].filter((pointer) => pointer.touching);
    for (const pointer of touching) {
      pointer.last = { ...pointer.last, type: "CANCEL", force_n: 0, click_count: 0, reason, coalesced: [] };
      pointer.touching = false;
    }
    return touching.map((pointer) => pointer.last);
  }

  /** End everything: the CANCELs, then a HOVER_EXIT for each pointer. */
  clear(reason = "DISCONNECTED") {
    const ended = [...this.cancelContacts(reason), ...this.events.map(exitOf)];
    this.#open.clear();
    return ended;
  }
}
