"""The one place that reads the machine's clock; everything below the shells is handed times instead."""

from __future__ import annotations

import time


def now_ns() -> int:
    """Monotonic time in nanoseconds, as used for capture stamps."""
    return time.monotonic_ns()


def unix_ms() -> int:
    """Milliseconds since 1970, to date a file with and nothing else."""
    return time.time_ns() // 1_000_000


class Pacer:
    """Holds a replay back so that each frame appears at its presentation time."""

    def __init__(self) -> None:
        self._offset_ns: int | None = None

    def delay_s(self, timestamp_ns: int) -> float:
        """Seconds until `timestamp_ns` is due, 0 when it is late; the first call sets the start."""
        if self._offset_ns is None:
            self._offset_ns = now_ns() - timestamp_ns
        return max(timestamp_ns + self._offset_ns - now_ns(), 0) / 1e9

    def wait(self, timestamp_ns: int) -> None:
        """Sleep until `timestamp_ns` is due; the first call sets the start. A late frame is not held back at all."""
        if delay_s := self.delay_s(timestamp_ns):
            time.sleep(delay_s)
