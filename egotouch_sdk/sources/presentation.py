"""From a file's own, possibly wrong, times to strictly rising timestamps. No I/O."""

from __future__ import annotations

import math

#: Frame rate assumed where a file names none (our choice: the most common camera rate).
FALLBACK_FPS = 30.0
#: A rate above this is metadata nonsense (our choice; fast industrial cameras stay below).
MAX_FPS = 1000.0
#: Two frames of one file never lie further apart; a larger step is a damaged time (our choice: an hour).
MAX_GAP_NS = 3600 * 10**9


def sound_fps(announced: float) -> float | None:
    """The announced frame rate, or None when it cannot be true (zero, negative, not finite, above 1000)."""
    return announced if math.isfinite(announced) and 0.0 < announced <= MAX_FPS else None


class PresentationTimes:
    """Turns each frame's presentation time into integer nanoseconds with the first frame at 0.

    A time that is not finite, does not rise or leaps by more than an hour is replaced by the last one plus one frame, so the
    result always rises.
    With `constant_fps` the file's times are ignored.
    """

    def __init__(self, fps: float | None, *, constant_fps: float | None = None) -> None:
        self._constant_fps = constant_fps
        self._step_ns = round(1e9 / (fps or FALLBACK_FPS))
        self._first_ms: float | None = None
        self._last_ns = -1
        self._count = 0
        self.repaired = 0

    def next_ns(self, time_ms: float) -> int:
        """Timestamp of the next frame, given the presentation time in milliseconds that the file states for it."""
        stamp_ns = self._constant_ns() if self._constant_fps else self._stated_ns(time_ms)
        self._last_ns = stamp_ns
        self._count += 1
        return stamp_ns

    def _constant_ns(self) -> int:
        return round(self._count * 1e9 / (self._constant_fps or FALLBACK_FPS))

    def _stated_ns(self, time_ms: float) -> int:
        if self._count == 0:
            self._first_ms = time_ms if math.isfinite(time_ms) else 0.0
            return 0
        since_last_ns = (time_ms - (self._first_ms or 0.0)) * 1e6 - self._last_ns
        if 1.0 <= since_last_ns <= MAX_GAP_NS:
            return self._last_ns + round(since_last_ns)
        self.repaired += 1
        return self._last_ns + self._step_ns
