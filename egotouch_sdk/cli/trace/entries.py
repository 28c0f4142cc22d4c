"""Events with the state that they lead from and to, and what caused them; no terminal, no clock."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from math import hypot

from egotouch_sdk.config import GestureConfig
from egotouch_sdk.state import Thresholds
from egotouch_sdk.touch_event import EventType, TouchEvent

ABSENT, HOVER, TOUCH = "absent", "hover", "touch"
#: What an event adds to a touch, and what takes it away again.
_ADDS = {EventType.DRAG_START: "drag", EventType.FORCE_ENTER: "force", EventType.LONG_CLICK: "long"}
_TAKES = {EventType.DRAG_END: "drag", EventType.FORCE_EXIT: "force"}
_WHOLE = {
    EventType.HOVER_ENTER: HOVER,
    EventType.HOVER_EXIT: ABSENT,
    EventType.DOWN: TOUCH,
    EventType.UP: HOVER,
    EventType.CANCEL: HOVER,
}


@dataclass(frozen=True, slots=True)
class Entry:
    """One line of the trace; `elapsed_ns` counts from the first frame."""

    elapsed_ns: int
    event: TouchEvent
    before: str
    after: str
    cause: str


def rounded(value: float) -> str:
    """One decimal, never "-0.0"."""
    return f"{round(value, 1) + 0.0:.1f}"


class Trace:
    """Turns events into entries, in the order in which they come."""

    def __init__(self, thresholds: Thresholds, gestures: GestureConfig) -> None:
        self.counts: Counter[EventType] = Counter()
        self._states: dict[int, tuple[str, ...]] = {}
        self._causes = _causes(thresholds, gestures)

    def note(self, event: TouchEvent, start_ns: int) -> Entry:
        """The entry of the next event of a source whose first frame was at `start_ns`."""
        before = self._states.get(event.pointer_id, (ABSENT,))
        after = _after(before, event.type)
        self._states[event.pointer_id] = after
        if after == (ABSENT,):
            del self._states[event.pointer_id]
        self.counts[event.type] += 1
        cause = event.reason.value if event.reason else self._causes.get(event.type, _no_cause)(event)
        return Entry(event.timestamp_ns - start_ns, event, "+".join(before), "+".join(after), cause)


def _after(before: tuple[str, ...], event_type: EventType) -> tuple[str, ...]:
    if event_type in _WHOLE:
        return (_WHOLE[event_type],)
    if event_type in _ADDS:
        return (*before, _ADDS[event_type])
    return tuple(word for word in before if word != _TAKES.get(event_type))


def _no_cause(event: TouchEvent) -> str:
    del event
    return ""


def _causes(thresholds: Thresholds, gestures: GestureConfig) -> dict[EventType, Callable[[TouchEvent], str]]:
    """In words, why an event of each type happened."""
    return {
        EventType.DOWN: lambda event: f"p {event.touch_probability:.2f} >= {thresholds.down:.2f}",
        EventType.UP: lambda event: f"p {event.touch_probability:.2f} < {thresholds.up:.2f}",
        EventType.CLICK: lambda event: f"held {event.duration_ms:.0f} ms",
        EventType.DOUBLE_CLICK: lambda event: f"click {event.click_count}",
        EventType.LONG_CLICK: lambda event: f"held {event.duration_ms:.0f} ms, {event.force_n:.1f} N",
        EventType.DRAG_START: lambda event: f"{hypot(event.dx_mm, event.dy_mm):.1f} mm > {gestures.touch_slop_mm:.1f} mm",
        EventType.DRAG_END: lambda event: f"{hypot(event.dx_mm, event.dy_mm):.1f} mm in {event.duration_ms:.0f} ms",
        EventType.FORCE_ENTER: lambda event: f"{event.force_n:.2f} N >= {gestures.force_enter_n:.2f} N",
        EventType.FORCE_CHANGE: lambda event: f"{event.force_n:.2f} N",
        EventType.FORCE_EXIT: lambda event: f"{event.force_n:.2f} N",
        EventType.FLING: lambda event: f"{hypot(event.velocity_x_mm_s, event.velocity_y_mm_s):.0f} mm/s",
    }
