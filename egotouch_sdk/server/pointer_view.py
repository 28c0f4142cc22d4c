"""What one client sees: a part of the events that follows the grammar by itself, whatever is filtered, late or unseen."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from egotouch_sdk.server.subscription import Subscription
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent

_OPENS_POINTER = frozenset({EventType.HOVER_ENTER, EventType.HOVER_MOVE, EventType.DOWN})
_ENDS_CONTACT = frozenset({EventType.UP, EventType.CANCEL})
_AFTERWARDS = frozenset({EventType.CLICK, EventType.DOUBLE_CLICK, EventType.FLING})
#: Events an app acts upon; a client that comes back never gets them live, however young they are.
_NEVER_REPLAYED = _AFTERWARDS | {EventType.LONG_CLICK}
#: Track of a contact that an event belongs to.
_DRAG = frozenset({EventType.DRAG_START, EventType.DRAG, EventType.DRAG_END})
_FORCE = frozenset({EventType.FORCE_ENTER, EventType.FORCE_CHANGE, EventType.FORCE_EXIT})

#: What a client gets of one frame, and whether it is late.
Shown = tuple[bool, tuple[TouchEvent, ...]]


@dataclass(slots=True)
class Pointer:
    """An open pointer as the client knows it: its contact (0 before the first), whether that is down, dragged, pressed or late."""

    contact_id: int = 0
    is_down: bool = False
    is_dragging: bool = False
    is_pressing: bool = False
    is_late: bool = False


class PointerView:
    """Filters a stream for one client and keeps it whole.

    - A pointer opens with HOVER_ENTER at its first event that is wanted, and closes with its HOVER_EXIT.
    - A contact is sent from its DOWN or not at all; drags and presses likewise. What was begun is always ended.
    - The first stale edge of a contact cancels it (DISCONNECTED) and the rest of it is left out; stale clicks are left out.
    - Clients that want late edges get them all instead, marked. A frame is late as a whole, since it is sent as a whole, and a contact
      that began late stays so to its end.

    `withheld` counts the stale edges with which a contact was cancelled or left out, and the stale clicks.
    """

    def __init__(self, subscription: Subscription, held: dict[int, Pointer] | None = None) -> None:
        self.subscription = subscription
        self.withheld = 0
        self._pointers = held or {}

    def apply(self, events: Sequence[TouchEvent], *, stale: bool = False, replay: bool = False) -> Shown:
        """What of one frame's events to send, in order."""
        late = self.subscription.late_edges and (stale or any(self._is_late(event, replay) for event in events))
        shown: list[TouchEvent] = []
        for event in events:
            shown += self._show(event, stale or (replay and event.type in _NEVER_REPLAYED), late)
        return late, tuple(shown)

    def _is_late(self, event: TouchEvent, replay: bool) -> bool:
        pointer = self._pointers.get(event.pointer_id)
        began_late = pointer is not None and pointer.is_late and event.contact_id == pointer.contact_id and not event.type.is_hover
        return began_late or (replay and event.type in _NEVER_REPLAYED)

    def _show(self, event: TouchEvent, stale: bool, late: bool) -> Iterator[TouchEvent]:
        pointer = self._pointers.get(event.pointer_id)
        if pointer is None:
            if event.type not in _OPENS_POINTER or not self.subscription.wants_place(event):
                return
            if event.type is EventType.DOWN and stale and not late:
                self.withheld += 1
                return
            pointer = self._pointers[event.pointer_id] = Pointer()
            yield _entering(event)
            if event.type is not EventType.DOWN:
                return
        if event.type.is_hover:
            yield from self._show_hover(event)
        elif event.type is EventType.DOWN:
            yield from self._show_down(pointer, event, stale, late)
        elif event.contact_id == pointer.contact_id:
            yield from self._show_contact(pointer, event, stale, late)

    def _show_hover(self, event: TouchEvent) -> Iterator[TouchEvent]:
        if event.type is EventType.HOVER_EXIT:
            del self._pointers[event.pointer_id]
            yield event
        elif self.subscription.wants_type(event.type) and self.subscription.wants_place(event):
            yield event

    def _show_down(self, pointer: Pointer, event: TouchEvent, stale: bool, late: bool) -> Iterator[TouchEvent]:
        wanted = self.subscription.wants_type(event.type) and self.subscription.wants_place(event)
        if not wanted or (stale and not late):
            self.withheld += wanted
            pointer.contact_id, pointer.is_down = 0, False
            return
        pointer.contact_id, pointer.is_down = event.contact_id, True
        pointer.is_dragging = pointer.is_pressing = False
        pointer.is_late = late
        yield event

    def _show_contact(self, pointer: Pointer, event: TouchEvent, stale: bool, late: bool) -> Iterator[TouchEvent]:
        if pointer.is_down == (event.type in _AFTERWARDS):
            return
        if stale and not late and event.type.is_edge:
            self.withheld += 1
            if pointer.is_down:
                yield from _cancelling(pointer, event)
            pointer.contact_id, pointer.is_down = 0, False
            return
        if self._belongs(pointer, event):
            pointer.is_down = pointer.is_down and event.type not in _ENDS_CONTACT
            yield event

    def _belongs(self, pointer: Pointer, event: TouchEvent) -> bool:
        """Whether the client has seen the beginning of what the event goes on with; notes beginnings and ends."""
        wanted = self.subscription.wants_type(event.type)
        if event.type in _DRAG:
            open_before = pointer.is_dragging
            pointer.is_dragging = (wanted and event.type is EventType.DRAG_START) or (open_before and event.type is EventType.DRAG)
            return pointer.is_dragging if event.type is EventType.DRAG_START else open_before and (wanted or event.type.is_edge)
        if event.type in _FORCE:
            open_before = pointer.is_pressing
            pointer.is_pressing = (wanted and event.type is EventType.FORCE_ENTER) or (open_before and event.type is EventType.FORCE_CHANGE)
            return pointer.is_pressing if event.type is EventType.FORCE_ENTER else open_before and (wanted or event.type.is_edge)
        return wanted or event.type in _ENDS_CONTACT


def _entering(event: TouchEvent) -> TouchEvent:
    """The HOVER_ENTER with which the client learns of a pointer that was there before."""
    if event.type is EventType.HOVER_ENTER:
        return event
    return replace(
        event,
        type=EventType.HOVER_ENTER,
        contact_id=event.contact_id - (event.type is EventType.DOWN),
        down_time_ns=None,
        force_n=0.0,
        dx_mm=0.0,
        dy_mm=0.0,
        velocity_x_mm_s=0.0,
        velocity_y_mm_s=0.0,
        coalesced=(),
    )


def _cancelling(pointer: Pointer, event: TouchEvent) -> Iterator[TouchEvent]:
    """The events that end a contact which went stale, in the order of a lift."""
    end = replace(
        event, type=EventType.CANCEL, reason=CancelReason.DISCONNECTED, force_n=0.0, force_sigma_n=None, click_count=0, coalesced=()
    )
    if pointer.is_dragging:
        yield replace(end, type=EventType.DRAG_END)
    if pointer.is_pressing:
        yield replace(end, type=EventType.FORCE_EXIT)
    yield end
