"""The one place that reads the machine's clock; everything below the shells is handed times instead."""

from __future__ import annotations

import time


def now_ns() -> int:
    """Monotonic time in nanoseconds, as used for capture stamps."""
    return time.monotonic_ns()


class Pacer:
    """Holds a replay back so that each frame appears at its presentation time."""

    def __init__(self) -> None:
        self._offset_ns: int | None = None

    def wait(self, timestamp_ns: int) -> None:
        """Sleep until `timestamp_ns` is due; the first call sets the start. A late frame is not held back at all."""
        if self._offset_ns is None:
            self._offset_ns = now_ns() - timestamp_ns
        remaining_ns = timestamp_ns + self._offset_ns - now_ns()
        if remaining_ns > 0:
            time.sleep(remaining_ns / 1e9)
