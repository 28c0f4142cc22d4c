"""A checker for the event grammar, for tests, debugging and clients.

per pointer:  HOVER_ENTER HOVER_MOVE* ( DOWN MOVE* ( UP | CANCEL ) HOVER_MOVE* )* HOVER_EXIT
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.touch_event import EventType, TouchEvent

_HOVERING = frozenset({EventType.HOVER_MOVE, EventType.DOWN, EventType.HOVER_EXIT})
_TOUCHING = frozenset({EventType.MOVE, EventType.UP, EventType.CANCEL})

#: What may follow each type of event in the same pointer.
MAY_FOLLOW: dict[EventType, frozenset[EventType]] = {
    EventType.HOVER_ENTER: _HOVERING,
    EventType.HOVER_MOVE: _HOVERING,
    EventType.DOWN: _TOUCHING,
    EventType.MOVE: _TOUCHING,
    EventType.UP: _HOVERING,
    EventType.CANCEL: _HOVERING,
    EventType.HOVER_EXIT: frozenset(),
}
_WITH_FORCE = frozenset({EventType.DOWN, EventType.MOVE})


@dataclass(frozen=True, slots=True)
class Violation:
    """One broken rule, and the event that broke it (None: the stream ended too early)."""

    rule: str
    event: TouchEvent | None


class GrammarVerifier:
    """Watches a stream of events; `violations` collects what is wrong with it, empty when nothing is."""

    def __init__(self) -> None:
        self.violations: list[Violation] = []
        self._open: dict[int, TouchEvent] = {}
        self._owners: dict[tuple[Handedness, Finger], int] = {}
        self._highest_id = 0
        self._time_ns = 0

    def feed(self, events: Iterable[TouchEvent]) -> tuple[Violation, ...]:
        """Check events in their order and return the violations they add."""
        found = [Violation(rule, event) for event in events for rule in self._check(event)]
        self.violations += found
        return tuple(found)

    def close(self) -> tuple[Violation, ...]:
        """Check that nothing was left open at the end of the stream."""
        found = [Violation(f"pointer {pointer_id} was left open after {last.type}", None) for pointer_id, last in self._open.items()]
        self._open.clear()
        self._owners.clear()
        self.violations += found
        return tuple(found)

    def _check(self, event: TouchEvent) -> Iterator[str]:
        if event.timestamp_ns < self._time_ns:
            yield f"time goes back from {self._time_ns} to {event.timestamp_ns} ns"
        self._time_ns = max(self._time_ns, event.timestamp_ns)
        if event.force_n != 0.0 and event.type not in _WITH_FORCE:
            yield f"{event.type} has a force of {event.force_n} N"
        before = self._open.get(event.pointer_id)
        yield from self._check_first(event) if before is None else self._check_next(before, event)
        self._note(event)

    def _check_first(self, event: TouchEvent) -> Iterator[str]:
        if event.type is not EventType.HOVER_ENTER:
            yield f"pointer {event.pointer_id} begins with {event.type}"
        if event.pointer_id <= self._highest_id:
            yield f"pointer_id {event.pointer_id} is used again"
        if event.contact_id != 0:
            yield f"pointer {event.pointer_id} begins with contact_id {event.contact_id}"
        if (event.hand, event.finger) in self._owners:
            yield f"the {event.hand} {event.finger} already is pointer {self._owners[event.hand, event.finger]}"

    def _check_next(self, before: TouchEvent, event: TouchEvent) -> Iterator[str]:
        if event.type not in MAY_FOLLOW[before.type]:
            yield f"{event.type} after {before.type}"
        if (event.hand, event.finger) != (before.hand, before.finger):
            yield f"pointer {event.pointer_id} changes from {before.hand} {before.finger} to {event.hand} {event.finger}"
        if event.contact_id != before.contact_id + (event.type is EventType.DOWN):
            yield f"contact_id goes from {before.contact_id} to {event.contact_id} on {event.type}"

    def _note(self, event: TouchEvent) -> None:
        self._highest_id = max(self._highest_id, event.pointer_id)
        if event.type is EventType.HOVER_EXIT:
            self._open.pop(event.pointer_id, None)
            if self._owners.get((event.hand, event.finger)) == event.pointer_id:
                del self._owners[event.hand, event.finger]
        else:
            self._open[event.pointer_id] = event
            self._owners[event.hand, event.finger] = event.pointer_id
