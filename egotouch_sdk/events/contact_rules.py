"""The rules that hold from one event of a pointer to the next."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot

from egotouch_sdk.events.order import CAUSED_BY, ON_SKIN, RAW
from egotouch_sdk.touch_event import EventType, TouchEvent

#: Millimetres by which sums of coordinates may differ: they travel as 32-bit floats.
ROUNDING_MM = 0.01
_T = EventType


class ContactRules:
    """One pointer and the contact it is in. `limit` is (mm/s, mm) for moves of a touch, None for any."""

    def __init__(self, first: TouchEvent, limit: tuple[float, float] | None = None) -> None:
        self.last = first
        self._limit = limit
        self._cause = first
        self._down: TouchEvent | None = None
        self._is_dragging = self._is_forced = self._was_dragged = self._was_long = False
        self._closing: TouchEvent | None = None

    def check(self, event: TouchEvent) -> Iterator[str]:
        """The rules that the next event breaks."""
        last, kind = self.last, event.type
        yield from self._check_pointer(last, event)
        if kind is _T.DOWN:
            self._down = event
            self._is_dragging = self._is_forced = self._was_dragged = self._was_long = False
        if event.timestamp_ns == last.timestamp_ns:
            if _way_mm(last, event) > ROUNDING_MM:
                yield f"{kind} is {_way_mm(last, event):.1f} mm away from the {last.type} of the same time"
        elif kind in CAUSED_BY:
            yield f"{kind} comes {(event.timestamp_ns - last.timestamp_ns) / 1e6:.1f} ms after the {last.type} before it"
        if kind in CAUSED_BY and self._cause.type not in CAUSED_BY[kind]:
            yield f"{kind} is caused by {self._cause.type}"
        if event.force_n != 0.0 and (kind not in ON_SKIN or (kind is _T.FORCE_EXIT and self._closes(event))):
            yield f"{kind} has a force of {event.force_n} N"
        if not kind.is_hover:
            yield from self._check_contact(event)
        yield from self._check_tracks(event)
        if kind in RAW:
            self._cause = event
        self.last = event

    def _check_pointer(self, last: TouchEvent, event: TouchEvent) -> Iterator[str]:
        if event.hand is not last.hand or event.finger is not last.finger:
            yield f"changes from {last.hand} {last.finger} to {event.hand} {event.finger} at {event.type}"
        if event.contact_id != last.contact_id + (event.type is _T.DOWN):
            yield f"contact_id goes from {last.contact_id} to {event.contact_id} on {event.type}"
        if last.type is _T.CLICK and last.click_count == 2 and event.type is not _T.DOUBLE_CLICK:
            yield f"click 2 is followed by {event.type}, not by double_click"

    def _check_contact(self, event: TouchEvent) -> Iterator[str]:
        """The DOWN that every event of a contact speaks of, and the way since then."""
        down = self._down
        if down is None:
            return
        if event.down_time_ns != down.timestamp_ns:
            yield f"{event.type} has down_time_ns {event.down_time_ns}, its down was at {down.timestamp_ns}"
        if hypot(event.x_mm - event.dx_mm - down.x_mm, event.y_mm - event.dy_mm - down.y_mm) > ROUNDING_MM:
            yield f"{event.type} is ({event.dx_mm:.2f}, {event.dy_mm:.2f}) mm from its down by its own account, but not by its place"
        if self._limit and event.type is not _T.DOWN and event.timestamp_ns > self._cause.timestamp_ns:
            speed_mm_s, slack_mm = self._limit
            way_mm, elapsed_ns = _way_mm(self._cause, event), event.timestamp_ns - self._cause.timestamp_ns
            if way_mm > speed_mm_s * elapsed_ns / 1e9 + slack_mm + ROUNDING_MM:
                yield f"{event.type} jumps {way_mm:.0f} mm in {elapsed_ns / 1e6:.1f} ms"

    def _check_tracks(self, event: TouchEvent) -> Iterator[str]:
        """Drags and force presses that open and close, clicks that fit to them."""
        kind, closing = event.type, self._closing
        if closing is not None:
            if kind not in (_T.FORCE_EXIT, _T.UP, _T.CANCEL):
                yield f"{kind} comes between {closing.type} and the end of the contact"
            elif (closing.timestamp_ns, closing.reason) != (event.timestamp_ns, event.reason):
                yield f"{closing.type} has another time or reason than the {kind} after it"
        if kind is _T.DRAG_START:
            if self._was_dragged:
                yield "second drag_start in one contact"
            self._is_dragging = self._was_dragged = True
        elif kind in (_T.DRAG, _T.DRAG_END):
            if not self._is_dragging:
                yield f"{kind} outside of a drag"
            self._is_dragging = self._is_dragging and kind is _T.DRAG
        elif kind is _T.FORCE_ENTER:
            if self._is_forced:
                yield "force_enter inside of a force press"
            self._is_forced = True
        elif kind in (_T.FORCE_CHANGE, _T.FORCE_EXIT):
            if not self._is_forced:
                yield f"{kind} outside of a force press"
            self._is_forced = self._is_forced and kind is _T.FORCE_CHANGE
        elif kind in (_T.UP, _T.CANCEL):
            if self._is_dragging or self._is_forced:
                yield f"{kind} before {'drag_end' if self._is_dragging else 'force_exit'}"
            self._is_dragging = self._is_forced = False
        elif kind is _T.LONG_CLICK:
            if self._was_dragged or self._was_long:
                yield f"long_click {'in a drag' if self._was_dragged else 'for the second time'}"
            self._was_long = True
        elif kind is _T.CLICK and self._was_dragged:
            yield "click after a drag"
        elif kind is _T.DOUBLE_CLICK and not self.last.click_count == event.click_count == 2:
            yield f"double_click has click_count {event.click_count} after {self.last.type} {self.last.click_count}"
        elif kind is _T.FLING and not self._was_dragged:
            yield "fling without a drag"
        self._closing = event if kind is _T.DRAG_END or (kind is _T.FORCE_EXIT and self._closes(event)) else None

    def _closes(self, exit_event: TouchEvent) -> bool:
        """True for a FORCE_EXIT that a lift or a cancel brings about, not a weaker press."""
        return exit_event.timestamp_ns > self._cause.timestamp_ns or exit_event.reason is not None


def _way_mm(one: TouchEvent, other: TouchEvent) -> float:
    return hypot(other.x_mm - one.x_mm, other.y_mm - one.y_mm)
