"""The listener to subclass, with the names that Android developers know."""

from __future__ import annotations

from typing import TYPE_CHECKING

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.touch_event import EventType, TouchEvent

if TYPE_CHECKING:
    from egotouch_sdk.listeners.error_event import ErrorEvent
    from egotouch_sdk.listeners.tracking import TrackingState

#: The method that gets each type of event.
METHODS: dict[EventType, str] = {
    EventType.DOWN: "onTouchDown",
    EventType.UP: "onTouchUp",
    EventType.MOVE: "onTouchMove",
    EventType.CANCEL: "onTouchCancel",
    EventType.DRAG_START: "onDragStart",
    EventType.DRAG: "onDrag",
    EventType.DRAG_END: "onDragEnd",
    EventType.CLICK: "onClick",
    EventType.DOUBLE_CLICK: "onDoubleClick",
    EventType.LONG_CLICK: "onLongClick",
    EventType.FORCE_ENTER: "onForce",
    EventType.FORCE_CHANGE: "onForce",
    EventType.FORCE_EXIT: "onForce",
    EventType.FLING: "onFling",
    EventType.HOVER_ENTER: "onHoverEnter",
    EventType.HOVER_MOVE: "onHoverMove",
    EventType.HOVER_EXIT: "onHoverExit",
}
#: The methods that get something other than a `TouchEvent`.
TRACKING_METHOD, ERROR_METHOD = "onTrackingChanged", "onError"
#: Every listener name, each once.
LISTENER_NAMES: tuple[str, ...] = (*dict.fromkeys(METHODS.values()), TRACKING_METHOD, ERROR_METHOD)


class TouchListener:
    """Override the methods that matter; the others do nothing.

    All are called one after the other on one thread, in the order in which things happened. Only what `onLongClick` returns counts.
    A method whose name differs from a listener's only in its capitals is refused with a `ConfigError` when the class is defined.
    """

    def __init_subclass__(cls, **kwargs: object) -> None:
        super().__init_subclass__(**kwargs)
        right = {name.lower(): name for name in LISTENER_NAMES}
        for name in vars(cls):
            if name.lower() in right and name not in LISTENER_NAMES:
                raise ConfigError(f"{cls.__name__}.{name} would never be called", hint=f"Name it {right[name.lower()]}")

    def onTouchDown(self, event: TouchEvent) -> None:
        """A finger has met the skin."""

    def onTouchUp(self, event: TouchEvent) -> None:
        """The finger has left the skin."""

    def onTouchMove(self, event: TouchEvent) -> None:
        """The finger is still on the skin; one call for each frame, merged when the listener is slow."""

    def onTouchCancel(self, event: TouchEvent) -> None:
        """The touch has ended without a lift, for `event.reason`; undo what it began and act on nothing."""

    def onDragStart(self, event: TouchEvent) -> None:
        """The finger has moved out of the touch slop."""

    def onDrag(self, event: TouchEvent) -> None:
        """The dragging finger has moved by `dx_mm`, `dy_mm` since its DOWN; merged when the listener is slow."""

    def onDragEnd(self, event: TouchEvent) -> None:
        """The drag is over; `event.reason` is set when it was cancelled."""

    def onClick(self, event: TouchEvent) -> None:
        """The finger has tapped."""

    def onDoubleClick(self, event: TouchEvent) -> None:
        """The finger has tapped twice at one place."""

    def onLongClick(self, event: TouchEvent) -> bool | None:
        """The finger rests on the skin; return True to keep this contact from becoming a click for any listener."""

    def onForce(self, event: TouchEvent) -> None:
        """A force press begins (FORCE_ENTER), changes (FORCE_CHANGE) or ends (FORCE_EXIT); `event.type` says which."""

    def onFling(self, event: TouchEvent) -> None:
        """The finger has left the skin in motion, with `velocity_x_mm_s`, `velocity_y_mm_s`."""

    def onHoverEnter(self, event: TouchEvent) -> None:
        """A fingertip has come over the skin."""

    def onHoverMove(self, event: TouchEvent) -> None:
        """The fingertip is still over the skin; merged when the listener is slow."""

    def onHoverExit(self, event: TouchEvent) -> None:
        """The fingertip is gone; its `pointer_id` does not come back."""

    def onTrackingChanged(self, state: TrackingState) -> None:
        """Other hands are seen than before, or the gate has opened or closed."""

    def onError(self, error: ErrorEvent) -> None:
        """A listener has thrown, or the source has failed."""
