"""A client's capture times on the server's clock, from nothing but when they arrive."""

from __future__ import annotations

from egotouch_sdk.server.limits import SECOND_NS

#: The shortest way is sought in the last one to two windows, so that clocks may drift and the network may change.
WINDOW_NS = 10 * SECOND_NS
#: How fast a new estimate of the offset takes effect: a tenth of the time that passes, so that speeds and durations stay true to 10 %.
SLEW_DIVISOR = 10


class ClientClock:
    """Maps one client's clock onto the server's.

    The offset is the least of `arrival - capture` in the last 10 to 20 seconds, that of the frame that was fastest on its way. So a
    capture time is late by the shortest time that a frame takes to arrive (some milliseconds on a good network), whatever the jitter.
    Mapped times always rise; the offset moves by a tenth of the time that passes at most, never at once. Needs no clock.
    """

    def __init__(self) -> None:
        self._offset_ns: int | None = None
        self._least_ns = 0
        self._least_before_ns: int | None = None
        self._window_end_ns = 0
        self._captured_ns = 0
        self._mapped_ns = -1

    def lag_ns(self, captured_ns: int, arrived_ns: int) -> int:
        """By how much longer than the shortest way this took; negative when it was shorter than all before, 0 for the first."""
        return 0 if self._offset_ns is None else arrived_ns - captured_ns - self._offset_ns

    def to_server(self, captured_ns: int, arrived_ns: int) -> int:
        """The capture time on the server's clock; `captured_ns` must rise."""
        way_ns = arrived_ns - captured_ns
        if self._offset_ns is None:
            self._offset_ns = self._least_ns = way_ns
            self._window_end_ns = arrived_ns + WINDOW_NS
        elif arrived_ns >= self._window_end_ns:
            self._least_before_ns, self._least_ns = self._least_ns, way_ns
            self._window_end_ns = arrived_ns + WINDOW_NS
        else:
            self._least_ns = min(self._least_ns, way_ns)
        best_ns = self._least_ns if self._least_before_ns is None else min(self._least_ns, self._least_before_ns)
        most_ns = (captured_ns - self._captured_ns) // SLEW_DIVISOR
        self._offset_ns += max(-most_ns, min(best_ns - self._offset_ns, most_ns))
        self._captured_ns = captured_ns
        self._mapped_ns = max(captured_ns + self._offset_ns, self._mapped_ns + 1)
        return self._mapped_ns
