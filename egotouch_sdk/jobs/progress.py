"""Progress of a batch in one line."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Progress:
    """Where a batch stands: `done` of `total` results are there, `new` of them from this run, which is `elapsed_s` old.

    `counted` sums the numbers that the new tasks returned.
    """

    total: int
    done: int
    new: int
    counted: int
    elapsed_s: float

    def line(self, noun: str, unit: str) -> str:
        """Done and total, rate, time left."""
        amount, what = (self.counted, unit) if unit else (self.new, noun)
        rate = amount / self.elapsed_s * 3600 if self.elapsed_s > 0 else 0.0
        left_s = (self.total - self.done) * self.elapsed_s / self.new if self.new else 0.0
        return f"{self.done}/{self.total} {noun}: {amount} new {what}, {rate:.0f} per hour, {_duration(left_s)} left"


def _duration(seconds: float) -> str:
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"
