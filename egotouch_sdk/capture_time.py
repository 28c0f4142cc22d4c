"""Time as the camera counts it."""

from __future__ import annotations

from egotouch_sdk.errors import FrameError


class CaptureTime:
    """When the newest frame was captured; after a step of more than `stall_ms` the past no longer counts."""

    def __init__(self, stall_ms: float) -> None:
        self._stall_ns = round(stall_ms * 1e6)
        self._now_ns: int | None = None

    def advance(self, timestamp_ns: int) -> bool:
        """Go on to the next frame; False after a stall. Raises `FrameError` when time does not rise; nothing changes then."""
        before_ns = self._now_ns
        if before_ns is not None and timestamp_ns <= before_ns:
            raise FrameError(f"frame time {timestamp_ns} ns is not after {before_ns} ns", hint="Call finish() before another source")
        self._now_ns = timestamp_ns
        return before_ns is None or timestamp_ns - before_ns <= self._stall_ns

    def reset(self) -> None:
        """Any time may follow."""
        self._now_ns = None
