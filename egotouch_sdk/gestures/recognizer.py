"""From touches to clicks, long clicks, drags, force presses and flings: three small state machines per contact.

Timing cases. Times count from the DOWN, in capture time; numbers are the defaults of `GestureConfig`. "..." is what went before.

  clicks
    touch, lift                            down, up, click
    ... lift within 40 ms of landing       down, up, click           no shortest click: the filter before took the flicker out
    held in place to 400 ms                long_click at the first frame seen at or after 400 ms; up, click when it lifts
    held, unseen at 400 ms, seen again     long_click at the first frame seen again, never while unseen
    held, unseen at 400 ms, lifted         up, click                 nobody saw it held
    pressed at 2.5 N or more for 100 ms    long_click, however early: a deep press
    ... weaker in one of those frames      the 100 ms begin anew
    seen more than 16 mm off at the lift   up, no click              it slid away between two frames
    lost while touching, found touching    down, up                  no click or long_click: within 100 ms of coming back it did not land
    ... after 100 ms of hovering           down, up, click

  double clicks: both of the same finger, DOWNs within 16 mm, on whatever surface and pointer
    second DOWN 40 to 300 ms after the UP  ... down, up, click (count 2), double_click
    sooner (a bounce) or later             ... down, up, click (count 1), which may be the first of another double click
    second one becomes long or a drag      as if there had been no first one
    three clicks                           click 1, click 2, double_click, click 1
    a cancel, a stall or an end between    click 1, click 1

  drags
    seen more than 5 mm from the DOWN      drag_start; drag with every later move; no click or long_click any more
    ... in the frame of the 400 ms         drag_start, no long_click
    ... after the long_click               drag_start all the same
    back within 5 mm                       drag goes on
    lift                                   drag_end, up
    lift at 50 mm/s or more                drag_end, up, fling with at most 1270 mm/s
    lift after resting                     drag_end, up              slower than that for 40 ms or two frames, whichever is longer
    lift after a gap longer than both      drag_end, up              nothing is known of its speed any more
    lift outside the slop, never a drag    up, click within 16 mm    no drag_start comes with an UP

  force presses
    1.5 N or more, also in the DOWN        force_enter
    changed by 0.1 N since last told       force_change
    below 1.2 N                            force_exit
    lift                                   force_exit, up

  in all of them
    unseen for up to 2 frames              nothing; timers go on with the next frame seen, after 2 velocity begins anew
    lost, swapped, stalled, ended          drag_end and force_exit with the reason of the cancel that follows; never up, click, fling

Order: what one frame causes follows the raw event of that frame, with its time and place: drag, force, long_click. What a lift or
a cancel ends comes before it, what a lift means after it. With the double click the second click also comes as click.

Not handled here: clicks with several fingers; a double click is not awaited, so a listener for single clicks hears its first half;
a drag that is only the skin giving way under a press is a drag once it is longer than the slop.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from math import hypot

from egotouch_sdk.config import GestureConfig
from egotouch_sdk.errors import GrammarError
from egotouch_sdk.gestures.clicks import ClickMemory
from egotouch_sdk.gestures.contact import Contact, GestureStates
from egotouch_sdk.gestures.landing import LandingMemory
from egotouch_sdk.gestures.table import CLOSING
from egotouch_sdk.touch_event import EventType, TouchEvent


class GestureRecognizer:
    """Adds to the raw events of the touch state machine what they mean.

    Raw events are HOVER_*, DOWN, MOVE, UP and CANCEL; each of them comes out again, those of a contact with their velocity.
    """

    def __init__(self, config: GestureConfig) -> None:
        self._config = config
        self._clicks = ClickMemory(config)
        self._landings = LandingMemory(config)
        self._contacts: dict[int, Contact] = {}

    def feed(self, events: Iterable[TouchEvent]) -> tuple[TouchEvent, ...]:
        """Take raw events in their order and return them with the derived ones among them.

        Raises `GrammarError` for an event of a contact whose DOWN was not fed.
        """
        return tuple(derived for event in events for derived in self._feed(event))

    def forget_clicks(self) -> None:
        """Let every next click be a first one: call it when time was interrupted."""
        self._clicks.clear()

    def states(self, pointer_id: int) -> GestureStates:
        """Where the contact of a pointer is; the first states while it hovers."""
        contact = self._contacts.get(pointer_id)
        return contact.states if contact else GestureStates()

    def _feed(self, event: TouchEvent) -> Iterator[TouchEvent]:
        self._landings.note(event)
        if event.type.is_hover:
            yield event
            return
        contact = self._contact_of(event)
        event = contact.with_velocity(event)
        types = contact.advance(event)
        if event.type in (EventType.UP, EventType.CANCEL):
            del self._contacts[event.pointer_id]
            yield from (replace(event, type=kind) for kind in types if kind in CLOSING)
            yield event
            yield from self._outcome(contact, event, [kind for kind in types if kind not in CLOSING])
        else:
            yield event
            yield from (replace(event, type=kind) for kind in types)

    def _contact_of(self, event: TouchEvent) -> Contact:
        if event.type is EventType.DOWN:
            follows_click, was_found = self._clicks.follows(event), self._landings.was_found(event)
            self._contacts[event.pointer_id] = Contact(self._config, event, follows_click=follows_click, was_found=was_found)
        if event.pointer_id not in self._contacts:
            raise GrammarError(f"{event.type} of pointer {event.pointer_id} comes without a down", hint="Feed every raw event, in order")
        return self._contacts[event.pointer_id]

    def _outcome(self, contact: Contact, end: TouchEvent, kinds: list[EventType]) -> Iterator[TouchEvent]:
        """What a lift meant, and what it means for the next click."""
        is_double = EventType.DOUBLE_CLICK in kinds
        if EventType.CLICK in kinds and not is_double and not contact.was_long:
            self._clicks.note(contact.down, end)
        else:
            self._clicks.forget(end.hand, end.finger)
        for kind in kinds:
            yield self._fling(end) if kind is EventType.FLING else replace(end, type=kind, click_count=2 if is_double else 1)

    def _fling(self, up: TouchEvent) -> TouchEvent:
        x_mm_s, y_mm_s = up.velocity_x_mm_s, up.velocity_y_mm_s
        scale = min(1.0, self._config.fling_max_mm_s / hypot(x_mm_s, y_mm_s))
        return replace(up, type=EventType.FLING, velocity_x_mm_s=scale * x_mm_s, velocity_y_mm_s=scale * y_mm_s)
