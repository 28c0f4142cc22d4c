"""The 1 euro filter: little jitter while slow, little lag while fast (Casiez, Roussel and Vogel, CHI 2012)."""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot, pi

from egotouch_sdk.errors import ConfigError, FrameError

#: Cutoff of the speed's own low-pass in hertz (the paper's choice).
DERIVATIVE_CUTOFF_HZ = 1.0


class OneEuroFilter:
    """Filters a vector of any length over capture time; all components share one cutoff, so no path is bent.

    `min_cutoff_hz` > 0 is the cutoff at rest; `beta` >= 0 the cutoff gained per unit of speed (hertz per unit per second), the length
    of the filtered speed vector. Raises `ConfigError` for values out of range.
    """

    def __init__(self, min_cutoff_hz: float, beta: float) -> None:
        if not min_cutoff_hz > 0 or not beta >= 0:
            raise ConfigError(f"1 euro filter got {min_cutoff_hz=}, {beta=}", hint="Need min_cutoff_hz > 0 and beta >= 0")
        self._min_cutoff_hz, self._beta = min_cutoff_hz, beta
        self.reset()

    def reset(self) -> None:
        """Forget the past; the next sample passes unchanged, as in a new filter."""
        self._time_ns: int | None = None
        self._value: tuple[float, ...] = ()
        self._speed: tuple[float, ...] = ()

    def apply(self, sample: Sequence[float], timestamp_ns: int) -> tuple[float, ...]:
        """The filtered sample; raises `FrameError` when time does not rise or the length changes."""
        raw = tuple(sample)
        if self._time_ns is None:
            self._value, self._speed = raw, (0.0,) * len(raw)
        else:
            if timestamp_ns <= self._time_ns or len(raw) != len(self._value):
                raise FrameError(
                    f"1 euro filter got {len(raw)} values at {timestamp_ns} ns after {len(self._value)} at {self._time_ns} ns",
                    hint="Feed samples of one length in order of time, or call reset()",
                )
            period_s = (timestamp_ns - self._time_ns) / 1e9
            slope = tuple((new - old) / period_s for new, old in zip(raw, self._value, strict=True))
            self._speed = _mix(slope, self._speed, _share(DERIVATIVE_CUTOFF_HZ, period_s))
            cutoff_hz = self._min_cutoff_hz + self._beta * hypot(*self._speed)
            self._value = _mix(raw, self._value, _share(cutoff_hz, period_s))
        self._time_ns = timestamp_ns
        return self._value


def _share(cutoff_hz: float, period_s: float) -> float:
    """Weight of the new sample in a first-order low-pass: 1 / (1 + tau / T) with tau = 1 / (2 pi cutoff)."""
    return 1.0 / (1.0 + 1.0 / (2 * pi * cutoff_hz * period_s))


def _mix(new: tuple[float, ...], old: tuple[float, ...], share: float) -> tuple[float, ...]:
    return tuple(share * n + (1 - share) * o for n, o in zip(new, old, strict=True))
