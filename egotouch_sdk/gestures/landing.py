"""Whether a finger was seen to land, or was found on the skin after it had been lost there."""

from __future__ import annotations

from egotouch_sdk.config import GestureConfig
from egotouch_sdk.gestures.contact import is_due
from egotouch_sdk.joints import Finger
from egotouch_sdk.touch_event import EventType, TouchEvent


class LandingMemory:
    """The fingers whose last touch was cancelled, on either hand since a swap changes the side, and since when each pointer hovers."""

    def __init__(self, config: GestureConfig) -> None:
        self._hover_ms = config.tap_timeout_ms
        self._lost: set[Finger] = set()
        self._entered_ns: dict[int, int] = {}

    def note(self, event: TouchEvent) -> None:
        """Take every raw event, in order."""
        if event.type is EventType.HOVER_ENTER:
            self._entered_ns[event.pointer_id] = event.timestamp_ns
        elif event.type is EventType.HOVER_EXIT:
            self._entered_ns.pop(event.pointer_id, None)
        elif event.type is EventType.CANCEL:
            self._lost.add(event.finger)
        elif event.type is EventType.UP:
            self._lost.discard(event.finger)

    def was_found(self, down: TouchEvent) -> bool:
        """True when the touch that begins with `down` may be the rest of the one that was cancelled before."""
        if down.finger not in self._lost:
            return False
        return not is_due(self._entered_ns.get(down.pointer_id, down.timestamp_ns), down.timestamp_ns, self._hover_ms)
