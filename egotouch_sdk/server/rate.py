"""How fast a client may talk."""

from __future__ import annotations

from egotouch_sdk.server.limits import SECOND_NS


class TokenBucket:
    """Lets `per_s` things happen per second on average, `burst` at once."""

    def __init__(self, per_s: int, burst: int, now_ns: int) -> None:
        self._per_s = per_s
        self._burst = burst
        self._level = float(burst)
        self._time_ns = now_ns

    def take(self, now_ns: int, amount: int = 1) -> bool:
        """True when one more may happen now, or `amount` of them."""
        self._level = min(self._burst, self._level + (now_ns - self._time_ns) * self._per_s / SECOND_NS)
        self._time_ns = now_ns
        if self._level < amount:
            return False
        self._level -= amount
        return True
