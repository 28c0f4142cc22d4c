"""A checker for the event grammar, for tests, debugging and clients; EVENTS.md has the grammar in full.

It is written down here a second time, on purpose: nothing is shared with the tables that make the events.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from egotouch_sdk.events.contact_rules import ContactRules
from egotouch_sdk.events.order import MAY_FOLLOW
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.touch_event import EventType, TouchEvent

#: How fast a touch may move, and how far beyond that; the defaults of `StateConfig`.
MAX_SPEED_MM_S, JUMP_SLACK_MM = 3000.0, 20.0


@dataclass(frozen=True, slots=True)
class Violation:
    """One broken rule, and the event that broke it (None: the stream ended too early)."""

    rule: str
    event: TouchEvent | None


def verify_events(events: Iterable[TouchEvent], max_speed_mm_s: float | None = MAX_SPEED_MM_S) -> tuple[Violation, ...]:
    """Check a finished stream of events, in the order in which they were sent; gives what is wrong with it, nothing when all is well.

    `max_speed_mm_s` is the speed above which a MOVE counts as a jump; None allows any.
    """
    verifier = GrammarVerifier(max_speed_mm_s)
    verifier.feed(events)
    verifier.close()
    return tuple(verifier.violations)


class GrammarVerifier:
    """Watches a running stream of events; `violations` collects what is wrong with it, empty when nothing is.

    `max_speed_mm_s` is the speed at which a touch may move on the limb and `slack_mm` the noise allowed on top; None allows any.
    """

    def __init__(self, max_speed_mm_s: float | None = MAX_SPEED_MM_S, slack_mm: float = JUMP_SLACK_MM) -> None:
        self.violations: list[Violation] = []
        self._limit = None if max_speed_mm_s is None else (max_speed_mm_s, slack_mm)
        self._open: dict[int, ContactRules] = {}
        self._owners: dict[tuple[Handedness, Finger], int] = {}
        self._single_clicks: set[tuple[Handedness, Finger]] = set()
        self._highest_id = 0
        self._time_ns = 0

    def feed(self, events: Iterable[TouchEvent]) -> tuple[Violation, ...]:
        """Check events in their order and return the violations they add."""
        found = [Violation(f"pointer {event.pointer_id}: {rule}", event) for event in events for rule in self._check(event)]
        self.violations += found
        return tuple(found)

    def close(self) -> tuple[Violation, ...]:
        """Check that nothing was left open at the end of the stream."""
        found = [Violation(f"pointer {number}: was left open after {rules.last.type}", None) for number, rules in self._open.items()]
        self._open.clear()
        self._owners.clear()
        self.violations += found
        return tuple(found)

    def _check(self, event: TouchEvent) -> Iterator[str]:
        if event.timestamp_ns < self._time_ns:
            yield f"time goes back from {self._time_ns} to {event.timestamp_ns} ns at {event.type}"
        else:
            self._time_ns = event.timestamp_ns
        rules = self._open.get(event.pointer_id)
        if rules is None:
            yield from self._check_first(event)
            rules = self._open[event.pointer_id] = ContactRules(event, self._limit)
        else:
            if event.type not in MAY_FOLLOW[rules.last.type]:
                yield f"{event.type} after {rules.last.type}"
            yield from rules.check(event)
        if event.type is EventType.CLICK or event.type is EventType.CANCEL:
            yield from self._check_count(event)
        self._note(event)

    def _check_first(self, event: TouchEvent) -> Iterator[str]:
        if event.type is not EventType.HOVER_ENTER:
            yield f"begins with {event.type}"
        if event.pointer_id <= self._highest_id:
            yield f"pointer_id {event.pointer_id} is used again"
        if event.contact_id != 0:
            yield f"begins with contact_id {event.contact_id}"
        if (event.hand, event.finger) in self._owners:
            yield f"the {event.hand} {event.finger} already is pointer {self._owners[event.hand, event.finger]}"

    def _check_count(self, event: TouchEvent) -> Iterator[str]:
        """A second click follows a first one of the same finger, with no cancel between them."""
        finger = event.hand, event.finger
        if event.click_count == 2 and finger not in self._single_clicks:
            yield f"click has click_count 2, and no single click of the {event.hand} {event.finger} came before it"
        if event.click_count == 1:
            self._single_clicks.add(finger)
        else:
            self._single_clicks.discard(finger)

    def _note(self, event: TouchEvent) -> None:
        if event.type is EventType.HOVER_EXIT:
            self._open.pop(event.pointer_id, None)
            if self._owners.get((event.hand, event.finger)) == event.pointer_id:
                del self._owners[event.hand, event.finger]
        elif event.pointer_id > self._highest_id or event.type is EventType.HOVER_ENTER:
            self._highest_id = max(self._highest_id, event.pointer_id)
            self._owners[event.hand, event.finger] = event.pointer_id
