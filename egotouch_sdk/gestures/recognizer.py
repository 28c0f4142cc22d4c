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
    seen 16 mm or more away at the lift    up, no click              it slid away between two frames

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
    lift after an unseen gap of more       drag_end, up              nothing is known of its speed
    lift outside the slop, never a drag    up                        no drag_start comes with an UP

  force presses
    1.5 N or more, also in the DOWN        force_enter
    changed by 0.1 N since last told       force_change
    below 1.2 N                            force_exit
    lift                                   force_exit, up

  in all of them
    unseen for up to 2 frames              nothing; velocity and timers go on with the next frame seen
    lost, swapped, stalled, ended          drag_end and force_exit with the reason of the cancel that follows; never up, click, fling

Order: what one frame causes follows the raw event of that frame, with its time and place: drag, force, long_click. What a lift or
a cancel ends comes before it, what a lift means after it. With the double click the second click also comes as click.

Not handled here: clicks with several fingers; a double click is not awaited, so a listener for single clicks hears its first half;
a drag that is only the skin giving way under a press is a drag once it is longer than the slop.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from math import hypot

from egotouch_sdk.config import GestureConfig
from egotouch_sdk.errors import GrammarError
from egotouch_sdk.gestures.clicks import ClickMemory
from egotouch_sdk.gestures.table import (
    CLOSING,
    DRAG,
    FORCE,
    PRESS,
    DragInput,
    DragState,
    ForceInput,
    ForceState,
    PressInput,
    PressState,
)
from egotouch_sdk.gestures.velocity import VelocityTracker
from egotouch_sdk.touch_event import EventType, TouchEvent

_ENDS = {EventType.UP, EventType.CANCEL}
#: A timer is due this much early: 12 frames of 33333333 ns are 400 ms.
_ROUNDING_NS = 1_000


@dataclass(frozen=True, slots=True)
class GestureStates:
    """Where one contact is in each of its three tracks."""

    press: PressState = PressState.NONE
    drag: DragState = DragState.STILL
    force: ForceState = ForceState.SOFT


@dataclass(slots=True)
class _Contact:
    """One touch, from DOWN to UP or CANCEL."""

    down: TouchEvent
    follows_click: bool
    velocity: VelocityTracker
    states: GestureStates = field(default_factory=GestureStates)
    told_force_n: float = 0.0
    deep_since_ns: int | None = None
    was_long: bool = False


class GestureRecognizer:
    """Adds to the raw events of the touch state machine what they mean.

    Raw events are HOVER_*, DOWN, MOVE, UP and CANCEL; each of them comes out again, those of a contact with their velocity.
    """

    def __init__(self, config: GestureConfig) -> None:
        self._config = config
        self._slop_mm = config.touch_slop_mm
        self._long_press_ns = round(config.long_press_timeout_ms * 1e6) - _ROUNDING_NS
        self._deep_ns = round(config.tap_timeout_ms * 1e6) - _ROUNDING_NS
        self._clicks = ClickMemory(config)
        self._contacts: dict[int, _Contact] = {}

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
        if event.type.is_hover:
            yield event
            return
        if event.type is EventType.DOWN:
            self._contacts[event.pointer_id] = _Contact(event, self._clicks.follows(event), VelocityTracker(self._config))
        contact = self._contacts.get(event.pointer_id)
        if contact is None:
            raise GrammarError(f"{event.type} of pointer {event.pointer_id} comes without a down", hint="Feed every raw event, in order")
        event = self._with_velocity(contact, event)
        types = self._advance(contact, event)
        if event.type in _ENDS:
            del self._contacts[event.pointer_id]
            yield from (replace(event, type=event_type) for event_type in types if event_type in CLOSING)
            yield event
            yield from self._outcome(contact, event, [event_type for event_type in types if event_type not in CLOSING])
        else:
            yield event
            yield from (replace(event, type=event_type) for event_type in types)

    def _with_velocity(self, contact: _Contact, event: TouchEvent) -> TouchEvent:
        if event.type in _ENDS:
            if contact.velocity.has_gap(event.timestamp_ns):
                return event
        else:
            contact.velocity.add(event.timestamp_ns, event.x_mm, event.y_mm)
        x_mm_s, y_mm_s = contact.velocity.velocity_mm_s()
        return replace(event, velocity_x_mm_s=x_mm_s, velocity_y_mm_s=y_mm_s) if x_mm_s or y_mm_s else event

    def _advance(self, contact: _Contact, event: TouchEvent) -> tuple[EventType, ...]:
        before = contact.states
        drag, drag_events = DRAG[before.drag, self._read_drag(contact, event)]
        force, force_events = FORCE[before.force, self._read_force(contact, event)]
        press, press_events = PRESS[before.press, self._read_press(contact, event)]
        contact.states = GestureStates(press, drag, force)
        if EventType.FORCE_ENTER in force_events or EventType.FORCE_CHANGE in force_events:
            contact.told_force_n = event.force_n
        contact.was_long = contact.was_long or EventType.LONG_CLICK in press_events
        return drag_events + force_events + press_events

    def _read_drag(self, contact: _Contact, event: TouchEvent) -> DragInput:
        if event.type is EventType.CANCEL:
            return DragInput.CANCELLED
        if event.type is EventType.UP:
            return DragInput.LIFTED_FAST if self._flings(contact, event) else DragInput.LIFTED
        return DragInput.FAR if hypot(event.dx_mm, event.dy_mm) > self._slop_mm else DragInput.NEAR

    def _flings(self, contact: _Contact, up: TouchEvent) -> bool:
        fling_min = self._config.fling_min_mm_s
        return hypot(up.velocity_x_mm_s, up.velocity_y_mm_s) >= fling_min <= contact.velocity.latest_speed_mm_s()

    def _read_force(self, contact: _Contact, event: TouchEvent) -> ForceInput:
        if event.type is EventType.CANCEL:
            return ForceInput.CANCELLED
        if event.type is EventType.UP:
            return ForceInput.LIFTED
        if event.force_n < self._config.force_exit_n:
            return ForceInput.WEAK
        if contact.states.force is ForceState.HARD and abs(event.force_n - contact.told_force_n) < self._config.force_step_n:
            return ForceInput.STEADY
        return ForceInput.STRONG if event.force_n >= self._config.force_enter_n else ForceInput.MIDDLE

    def _read_press(self, contact: _Contact, event: TouchEvent) -> PressInput:
        if event.type is EventType.CANCEL:
            return PressInput.CANCELLED
        way_mm = hypot(event.dx_mm, event.dy_mm)
        if event.type is EventType.UP:
            if way_mm > self._config.double_click_slop_mm:
                return PressInput.LIFTED_AWAY
            return PressInput.LIFTED_AGAIN if contact.follows_click else PressInput.LIFTED
        is_deep = self._is_deep(contact, event)
        if event.type is EventType.DOWN:
            return PressInput.LANDED
        if way_mm > self._slop_mm:
            return PressInput.LEFT_SLOP
        is_due = is_deep or event.timestamp_ns - contact.down.timestamp_ns >= self._long_press_ns
        return PressInput.DUE if is_due else PressInput.STAYED

    def _is_deep(self, contact: _Contact, event: TouchEvent) -> bool:
        if event.force_n < self._config.deep_press_n:
            contact.deep_since_ns = None
            return False
        if contact.deep_since_ns is None:
            contact.deep_since_ns = event.timestamp_ns
        return event.timestamp_ns - contact.deep_since_ns >= self._deep_ns

    def _outcome(self, contact: _Contact, end: TouchEvent, types: list[EventType]) -> Iterator[TouchEvent]:
        """What a lift meant, and what it means for the next click."""
        is_double = EventType.DOUBLE_CLICK in types
        is_single = EventType.CLICK in types and not is_double and not contact.was_long
        if is_single:
            self._clicks.note(contact.down, end)
        else:
            self._clicks.forget(end.hand, end.finger)
        for event_type in types:
            if event_type is EventType.FLING:
                yield self._fling(end)
            else:
                yield replace(end, type=event_type, click_count=2 if is_double else 1)

    def _fling(self, up: TouchEvent) -> TouchEvent:
        scale = min(1.0, self._config.fling_max_mm_s / hypot(up.velocity_x_mm_s, up.velocity_y_mm_s))
        return replace(
            up, type=EventType.FLING, velocity_x_mm_s=scale * up.velocity_x_mm_s, velocity_y_mm_s=scale * up.velocity_y_mm_s
        )
