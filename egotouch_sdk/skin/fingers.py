"""Which finger has to do with which view: the table driven by touch events."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from egotouch_sdk.errors import GrammarError
from egotouch_sdk.listeners.touch_listener import METHODS
from egotouch_sdk.skin.table import TABLE, Call, ViewInput, ViewState
from egotouch_sdk.skin.views import SkinView
from egotouch_sdk.touch_event import EventType, TouchEvent

_DERIVED = frozenset(
    {
        EventType.DRAG_START,
        EventType.DRAG,
        EventType.DRAG_END,
        EventType.FORCE_ENTER,
        EventType.FORCE_CHANGE,
        EventType.FORCE_EXIT,
    }
)
#: Views make their own clicks from DOWN and UP; a fling belongs to no view, since the finger has left.
_IGNORED = frozenset({EventType.CLICK, EventType.DOUBLE_CLICK, EventType.FLING})
_FIXED_INPUT: dict[EventType, ViewInput] = {
    EventType.HOVER_EXIT: ViewInput.GONE,
    EventType.CANCEL: ViewInput.CANCEL,
    EventType.LONG_CLICK: ViewInput.LONG_CLICK,
    **dict.fromkeys(_DERIVED, ViewInput.DERIVED),
}


@dataclass(frozen=True, slots=True)
class FingerState:
    """One finger: its last event, and the view it hovers over or has captured (None when it is away)."""

    event: TouchEvent
    state: ViewState = ViewState.AWAY
    view: SkinView | None = None
    #: onLongClick has returned True in this contact, which keeps it from clicking.
    is_consumed: bool = False


@dataclass(frozen=True, slots=True)
class ViewCall:
    """A listener to call: its name and the view it belongs to."""

    view: SkinView
    name: str


class Fingers:
    """Tells from touch events which views are hovered over and pressed, and which listeners that concerns.

    A finger over overlapping views is on the topmost. One that hovered over a view stays on it up to half its slop beyond the edge,
    unless it is still inside and another view lies on top there. What is highlighted is what a press gets.
    A view that one finger has captured ignores others until they are lifted: their whole contact passes by.
    """

    def __init__(self, views: Sequence[SkinView]) -> None:
        self._top_down = tuple(reversed(views))
        self._fingers: dict[int, FingerState] = {}

    @property
    def states(self) -> tuple[FingerState, ...]:
        """All fingers over or on the skin, in order of appearance."""
        return tuple(self._fingers.values())

    def step(self, event: TouchEvent) -> tuple[ViewCall, ...]:
        """Take in one event; the calls come in the order in which they must be made.

        Raises `GrammarError` for an event that breaks the event grammar; the state is then as it was.
        """
        if event.type in _IGNORED:
            return ()
        before = self._fingers.get(event.pointer_id) or FingerState(event)
        cause, target = self._read(before, event)
        row = TABLE.get((before.state, cause))
        if row is None:
            raise GrammarError(f"a {event.type} of pointer {event.pointer_id} while its finger is {before.state}")
        state, calls = row
        after = FingerState(event, state, None if state is ViewState.AWAY else target, before.is_consumed and cause is not ViewInput.PRESS)
        if event.type is EventType.HOVER_EXIT:
            self._fingers.pop(event.pointer_id, None)
        else:
            self._fingers[event.pointer_id] = after
        return tuple(self._calls(calls, before, target, event))

    def consume(self, pointer_id: int) -> None:
        """Keep the finger's contact from becoming a click."""
        if pointer_id in self._fingers:
            self._fingers[pointer_id] = replace(self._fingers[pointer_id], is_consumed=True)

    def captured_by(self, event: TouchEvent) -> SkinView | None:
        """The view that the finger of an event has captured."""
        finger = self._fingers.get(event.pointer_id)
        return finger.view if finger is not None and finger.state in (ViewState.PRESSED, ViewState.STRAYED) else None

    def _read(self, finger: FingerState, event: TouchEvent) -> tuple[ViewInput, SkinView | None]:
        """What an event means, and the view it concerns."""
        if event.type in (EventType.HOVER_ENTER, EventType.HOVER_MOVE):
            view = self._view_under(event, finger.view)
            if view is None:
                return ViewInput.HOVER_OFF, None
            return (ViewInput.HOVER_ON if view is finger.view else ViewInput.HOVER_ONTO), view
        if event.type is EventType.DOWN:
            view = self._view_under(event, finger.view)
            is_free = view is not None and not self._is_captured(view, event.pointer_id)
            return (ViewInput.PRESS, view) if is_free else (ViewInput.PRESS_NOTHING, None)
        if event.type in _FIXED_INPUT:
            return _FIXED_INPUT[event.type], finger.view
        is_inside = finger.view is not None and finger.view.region.is_kept(event, finger.view.slop_mm)
        if event.type is EventType.MOVE:
            return (ViewInput.INSIDE if is_inside else ViewInput.OUTSIDE), finger.view
        return (ViewInput.LIFT_INSIDE if is_inside else ViewInput.LIFT_OUTSIDE), finger.view

    def _view_under(self, event: TouchEvent, current: SkinView | None) -> SkinView | None:
        if current is not None and not current.region.is_hit(event) and current.region.is_kept(event, current.hover_slop_mm):
            return current
        return next((view for view in self._top_down if view.region.is_hit(event)), None)

    def _is_captured(self, view: SkinView, pointer_id: int) -> bool:
        return any(
            finger.view is view and finger.state in (ViewState.PRESSED, ViewState.STRAYED)
            for other, finger in self._fingers.items()
            if other != pointer_id
        )

    @staticmethod
    def _calls(calls: tuple[Call, ...], before: FingerState, target: SkinView | None, event: TouchEvent) -> list[ViewCall]:
        made = []
        for call in calls:
            view = before.view if call is Call.HOVER_EXIT else target
            assert view is not None, f"{call} without a view"
            if call is not Call.CLICK or not before.is_consumed:
                made.append(ViewCall(view, METHODS[event.type] if call is Call.DERIVED else str(call)))
        return made
