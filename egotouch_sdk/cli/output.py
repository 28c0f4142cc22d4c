"""How events, numbers and progress are printed."""

from __future__ import annotations

import json
import sys
from math import hypot
from typing import Any

from egotouch_sdk.clock import now_ns
from egotouch_sdk.touch_event import EventType, TouchEvent

#: On a terminal one line is rewritten often; elsewhere every report is a line of its own.
_REPORT_EVERY_NS = {True: 250_000_000, False: 1_000_000_000}


def print_json(value: Any) -> None:
    """One JSON object on one line, out at once."""
    sys.stdout.write(json.dumps(value, separators=(",", ":"), allow_nan=False) + "\n")
    sys.stdout.flush()


def event_line(event: TouchEvent) -> str:
    """One event for people: time, what, which finger, where on which skin, how sure, and what matters to its kind."""
    words = f"{event.timestamp_ns / 1e9:9.3f} s  {event.type.value:<12}  {event.hand.value:<5} {event.finger.value:<6}"
    place = f"{event.surface.value:<13} ({event.x_mm:z4.0f}, {event.y_mm:z4.0f}) mm  p {event.touch_probability:.2f}"
    reason = f"  {event.reason.value}" if event.reason else ""
    return f"{words}  {place}{_detail(event)}{reason}"


def _detail(event: TouchEvent) -> str:
    if event.type in (EventType.DOWN, EventType.FORCE_ENTER, EventType.LONG_CLICK):
        return f"  {event.force_n:.1f} N"
    if event.type in (EventType.DRAG_START, EventType.DRAG_END):
        return f"  {hypot(event.dx_mm, event.dy_mm):.0f} mm"
    if event.type is EventType.FLING:
        return f"  {hypot(event.velocity_x_mm_s, event.velocity_y_mm_s):.0f} mm/s"
    return ""


class Progress:
    """Frames (or another `unit`) done, on stderr: one line that is rewritten on a terminal, or a line now and then with `always`."""

    def __init__(self, total: int | None, *, always: bool = False, unit: str = "frames") -> None:
        self._total = total
        self._unit = unit
        self._in_place = sys.stderr.isatty()
        self._on = always or self._in_place
        self._start_ns = self._last_ns = now_ns()
        self._done = 0
        self._wrote = False

    def step(self) -> None:
        """Count one frame and report if it is time."""
        self._done += 1
        now = now_ns()
        if self._on and now - self._last_ns >= _REPORT_EVERY_NS[self._in_place]:
            self._last_ns = now
            self._write(now)

    def clear(self) -> None:
        """Take the rewritten line off the terminal, to print something else."""
        if self._wrote and self._in_place:
            sys.stderr.write("\r\x1b[K")
            sys.stderr.flush()
            self._wrote = False

    def _write(self, now: int) -> None:
        rate = self._done / max((now - self._start_ns) / 1e9, 1e-9)
        share = f" of {self._total} ({100 * self._done / self._total:.0f} %)" if self._total else ""
        line = f"{self._done} {self._unit}{share}, {rate:.1f} per second"
        sys.stderr.write(f"\r\x1b[K{line}" if self._in_place else f"{line}\n")
        sys.stderr.flush()
        self._wrote = True


class EventPrinter:
    """Prints events as they come, as JSON or, without those that come with every frame, as lines for people."""

    def __init__(self, as_json: bool, progress: Progress) -> None:
        self._as_json = as_json
        self._progress = progress

    def __call__(self, event: TouchEvent) -> None:
        """Print one event."""
        if not event.type.is_edge and not self._as_json:
            return
        self._progress.clear()
        if self._as_json:
            print_json(event.to_dict())
        else:
            print(event_line(event), flush=True)
