// Which pointers and contacts are open on this page. What ends here by a local CANCEL stays ended: later events of the same
// contact are dropped until its next DOWN, so nothing can stick and nothing clicks late.

const HOVER = new Set(["HOVER_ENTER", "HOVER_MOVE", "HOVER_EXIT"]);
const AFTER_UP = new Set(["CLICK", "DOUBLE_CLICK", "FLING"]);

const contactOf = (event) => `${event.pointerId}/${event.contactId}`;
const exitOf = (last) => ({ ...last, type: "HOVER_EXIT", downTimeMs: null, forceN: 0, clickCount: 0, reason: null, coalesced: [] });
const isTouching = (type) => !HOVER.has(type) && !AFTER_UP.has(type) && type !== "UP" && type !== "CANCEL";

export class OpenPointers {
  #open = new Map(); // pointerId -> {last: event, touching: boolean}
  #ended = new Set(); // "pointerId/contactId" of contacts that were cancelled here

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
    const pointer = this.#open.get(event.pointerId);
    if (event.type === "HOVER_EXIT") {
      this.#open.delete(event.pointerId);
      return pointer !== undefined;
    }
    if (HOVER.has(event.type)) {
      this.#open.set(event.pointerId, { last: event, touching: false });
      return true;
    }
    if (event.type === "DOWN") {
      this.#open.set(event.pointerId, { last: event, touching: true });
      return true;
    }
    if (AFTER_UP.has(event.type)) return pointer?.last.contactId === event.contactId && pointer.last.type !== "CANCEL";
    if (!pointer?.touching) return false;
    pointer.last = event;
    pointer.touching = event.type !== "UP" && event.type !== "CANCEL";
    return true;
  }

  /** End every contact; gives the CANCEL events to show. The pointers themselves stay until the server says otherwise. */
  cancelContacts(reason = "DISCONNECTED") {
    const touching = [...this.#open.values()].filter((pointer) => pointer.touching);
    for (const pointer of touching) {
      pointer.last = this.#cancelled(pointer.last, reason);
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

  /** Another run of the server counts its pointers anew. */
  forgetEnded() {
    this.#ended.clear();
  }

  /**
   * Take over the server's list of open pointers: what it no longer has ends here (the CANCELs and HOVER_EXITs are returned). A
   * contact that began unseen is shown, one that was cancelled here stays ended.
   */
  reconcile(snapshot) {
    const known = new Map(snapshot.map((last) => [last.pointerId, last]));
    const ended = [];
    for (const [pointerId, { last, touching }] of this.#open) {
      const now = known.get(pointerId);
      if (touching && now?.contactId !== last.contactId) ended.push(this.#cancelled(last, "DISCONNECTED"));
      if (!now) ended.push(exitOf(this.#open.get(pointerId).last));
    }
    this.#open.clear();
    for (const last of snapshot) {
      this.#open.set(last.pointerId, { last, touching: isTouching(last.type) && !this.#ended.has(contactOf(last)) });
    }
    return ended;
  }

  #cancelled(last, reason) {
    this.#ended.add(contactOf(last));
    return { ...last, type: "CANCEL", forceN: 0, clickCount: 0, reason, coalesced: [] };
  }
}
