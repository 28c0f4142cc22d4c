"""How fast a finger moves over the skin."""

from __future__ import annotations

from collections import deque
from math import hypot

from egotouch_sdk.config import GestureConfig


class VelocityTracker:
    """Velocity of one contact: a line through the places of the last `velocity_horizon_ms`, by least squares.

    A line rather than the parabola of Android's VelocityTracker: at 30 fps the horizon holds four places, and a parabola through
    four places of a hand landmark follows its noise (our choice). At low frame rates the horizon is never less than two frames.
    Places before a gap longer than `stopped_ms` and two frames are forgotten (Android's ASSUME_POINTER_STOPPED).
    """

    def __init__(self, config: GestureConfig) -> None:
        self._horizon_ns = round(config.velocity_horizon_ms * 1e6)
        self._stopped_ns = round(config.stopped_ms * 1e6)
        self._places: deque[tuple[int, float, float]] = deque()
        self._frame_ns = 0

    def add(self, timestamp_ns: int, x_mm: float, y_mm: float) -> None:
        """Note where the finger is; time rises from call to call."""
        places = self._places
        if self.has_gap(timestamp_ns):
            places.clear()
        places.append((timestamp_ns, x_mm, y_mm))
        if len(places) > 1:
            self._frame_ns = (timestamp_ns - places[0][0]) // (len(places) - 1)
        oldest_ns = timestamp_ns - max(self._horizon_ns, 2 * self._frame_ns)
        while places[0][0] < oldest_ns:
            places.popleft()

    def has_gap(self, timestamp_ns: int) -> bool:
        """True when the finger was not seen for so long before `timestamp_ns` that nothing is known of its velocity."""
        return len(self._places) > 1 and timestamp_ns - self._places[-1][0] > self._window_ns()

    def velocity_mm_s(self) -> tuple[float, float]:
        """Velocity (x, y) at the last place, 0 before the second."""
        count = len(self._places)
        if count < 2:
            return 0.0, 0.0
        last_ns = self._places[-1][0]
        mean_s = mean_x = mean_y = 0.0
        for time_ns, x, y in self._places:
            mean_s += (time_ns - last_ns) / 1e9
            mean_x += x
            mean_y += y
        mean_s, mean_x, mean_y = mean_s / count, mean_x / count, mean_y / count
        spread = along_x = along_y = 0.0
        for time_ns, x, y in self._places:
            offset_s = (time_ns - last_ns) / 1e9 - mean_s
            spread += offset_s * offset_s
            along_x += offset_s * (x - mean_x)
            along_y += offset_s * (y - mean_y)
        return along_x / spread, along_y / spread

    def latest_speed_mm_s(self) -> float:
        """Mean speed over the last `stopped_ms`, never over less than two frames: near 0 once the finger has come to rest."""
        last_ns, last_x, last_y = self._places[-1]
        since_ns = last_ns - self._window_ns()
        first_ns, x, y = next(place for place in self._places if place[0] >= since_ns)
        return hypot(last_x - x, last_y - y) / (last_ns - first_ns) * 1e9 if last_ns > first_ns else 0.0

    def _window_ns(self) -> int:
        return max(self._stopped_ns, 2 * self._frame_ns)
