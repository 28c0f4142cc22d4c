"""Which click is the second half of a double click."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

from egotouch_sdk.config import GestureConfig
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.touch_event import TouchEvent


@dataclass(frozen=True, slots=True)
class _FirstClick:
    up_ns: int
    x_mm: float
    y_mm: float


class ClickMemory:
    """The last single click of each finger."""

    def __init__(self, config: GestureConfig) -> None:
        self._slop_mm = config.double_click_slop_mm
        self._timeout_ns = round(config.double_tap_timeout_ms * 1e6)
        self._min_ns = round(config.double_tap_min_ms * 1e6)
        self._first: dict[tuple[Handedness, Finger], _FirstClick] = {}

    def follows(self, down: TouchEvent) -> bool:
        """True when a touch that begins with `down` follows a click of the same finger in time and place."""
        first = self._first.get((down.hand, down.finger))
        if first is None or not self._min_ns <= down.timestamp_ns - first.up_ns <= self._timeout_ns:
            return False
        return hypot(down.x_mm - first.x_mm, down.y_mm - first.y_mm) <= self._slop_mm

    def note(self, down: TouchEvent, up: TouchEvent) -> None:
        """Remember a single click; its place is that of its DOWN, as on Android."""
        self._first[down.hand, down.finger] = _FirstClick(up.timestamp_ns, down.x_mm, down.y_mm)

    def forget(self, hand: Handedness, finger: Finger) -> None:
        """Let the next click of this finger be a first one."""
        self._first.pop((hand, finger), None)

    def clear(self) -> None:
        """Let the next click of every finger be a first one."""
        self._first.clear()
