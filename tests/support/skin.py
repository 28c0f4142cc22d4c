"""A finger over skin views, and what the views were told."""

from __future__ import annotations

from collections import deque
from typing import Any

from egotouch_sdk.joints import Handedness
from egotouch_sdk.skin import SkinViewGroup
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent
from tests.support.events import make_event

VIEW_LISTENERS = (
    "onHoverEnter",
    "onHoverMove",
    "onHoverExit",
    "onTouchDown",
    "onTouchMove",
    "onTouchUp",
    "onTouchCancel",
    "onDragStart",
    "onDrag",
    "onDragEnd",
    "onForce",
    "onLongClick",
    "onClick",
)
FRAME_NS = 33_333_333


class SkinFinger:
    """One fingertip whose events go straight to a group; every verb is one event, a frame later."""

    def __init__(
        self, group: SkinViewGroup, pointer_id: int = 1, hand: Handedness = Handedness.RIGHT, surface: Surface = Surface.PALM
    ) -> None:
        self.group, self.pointer_id, self.hand, self.surface = group, pointer_id, hand, surface
        self.time_ns, self.contact_id = 0, 0
        self.down: TouchEvent | None = None
        self.is_seen = False
        self.last = (0.0, 0.0)

    def hover(self, x_mm: float, y_mm: float) -> TouchEvent:
        """Be above a place."""
        first, self.is_seen = not self.is_seen, True
        return self._send(EventType.HOVER_ENTER if first else EventType.HOVER_MOVE, x_mm, y_mm)

    def touch(self, x_mm: float, y_mm: float, force_n: float = 1.0) -> TouchEvent:
        """Come down on a place."""
        if not self.is_seen:
            self.hover(500.0, 500.0)
        self.contact_id += 1
        return self._send(EventType.DOWN, x_mm, y_mm, force_n=force_n)

    def slide(self, x_mm: float, y_mm: float, force_n: float = 1.0) -> TouchEvent:
        """Be on another place."""
        return self._send(EventType.MOVE, x_mm, y_mm, force_n=force_n)

    def rest(self) -> bool:
        """Rest until it is a long click; gives what the group returned."""
        return self.group.handle(self._event(EventType.LONG_CLICK, *self.last))

    def derive(self, event_type: EventType, force_n: float = 1.0) -> TouchEvent:
        """Something that follows from the last move: a drag or a force event."""
        return self._send(event_type, *self.last, force_n=force_n)

    def lift(self, x_mm: float | None = None, y_mm: float | None = None) -> TouchEvent:
        """Leave the skin where it is, or at a place."""
        return self._send(EventType.UP, self.last[0] if x_mm is None else x_mm, self.last[1] if y_mm is None else y_mm)

    def cancel(self, reason: CancelReason = CancelReason.TRACKING_LOST) -> TouchEvent:
        """Lose the touch."""
        return self._send(EventType.CANCEL, *self.last, reason=reason)

    def leave(self) -> TouchEvent:
        """Be gone."""
        self.is_seen = False
        return self._send(EventType.HOVER_EXIT, *self.last)

    def tap(self, x_mm: float, y_mm: float) -> TouchEvent:
        """Come down and lift at once, with the CLICK that the engine sends."""
        self.touch(x_mm, y_mm)
        self.lift()
        return self._send(EventType.CLICK, x_mm, y_mm)

    def _send(self, event_type: EventType, x_mm: float, y_mm: float, **fields: Any) -> TouchEvent:
        event = self._event(event_type, x_mm, y_mm, **fields)
        self.group.handle(event)
        return event

    def _event(self, event_type: EventType, x_mm: float, y_mm: float, **fields: Any) -> TouchEvent:
        self.time_ns += FRAME_NS
        self.last = (x_mm, y_mm)
        if not event_type.is_hover and event_type is not EventType.DOWN:
            assert self.down is not None
            fields["down_time_ns"] = self.down.timestamp_ns
        event = make_event(
            event_type,
            self.time_ns,
            pointer_id=self.pointer_id,
            contact_id=self.contact_id,
            hand=self.hand,
            surface=self.surface,
            x_mm=x_mm,
            y_mm=y_mm,
            **fields,
        )
        if event_type is EventType.DOWN:
            self.down = event
        return event


class ViewLog:
    """Listens to everything that the views of a group are told, in order."""

    def __init__(self, group: SkinViewGroup) -> None:
        self.calls: deque[tuple[str, str]] = deque()
        for view in group.layout.views:
            handle = group.view(view.name)
            for name in VIEW_LISTENERS:
                getattr(handle, name)(self._note(name, view.name))

    def expect(self, *calls: str) -> None:
        """The next calls are these, each as `view.onName`."""
        for call in calls:
            assert self.calls, f"expected {call}, but nothing happened"
            view, name = self.calls.popleft()
            assert f"{view}.{name}" == call, f"expected {call}, got {view}.{name}, then {list(self.calls)}"

    def expect_nothing_else(self) -> None:
        """No view was told anything more."""
        assert not self.calls, f"unexpected {list(self.calls)}"

    def forget(self) -> None:
        """What happened so far does not matter."""
        self.calls.clear()

    def _note(self, name: str, view: str) -> Any:
        def note(event: TouchEvent) -> None:
            self.calls.append((view, name))

        return note
