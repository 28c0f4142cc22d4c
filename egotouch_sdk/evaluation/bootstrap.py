"""Confidence intervals by drawing whole participants (or recordings) again, never single frames."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import nan
from typing import TypeVar

import numpy as np

Interval = tuple[float, float]
_Unit = TypeVar("_Unit")

#: Draws behind an interval, and its level (our choice: the usual ones).
DRAWS, LEVEL = 2000, 0.95


def interval_of_mean(values: Sequence[float], draws: int = DRAWS, seed: int = 0) -> Interval:
    """Percentile interval of the mean of one value per participant, nan left out; (nan, nan) for fewer than two."""
    known = np.array([value for value in values if not np.isnan(value)], np.float64)
    if len(known) < 2:
        return nan, nan
    drawn = np.random.default_rng(seed).integers(0, len(known), (draws, len(known)))
    return _percentiles(known[drawn].mean(axis=1))


def interval_of(units: Sequence[_Unit], figure: Callable[[Sequence[_Unit]], float], draws: int = DRAWS, seed: int = 0) -> Interval:
    """Percentile interval of any figure of a pool of units, drawn whole; draws without the figure (nan) are left out."""
    if len(units) < 2:
        return nan, nan
    rng = np.random.default_rng(seed)
    values = np.array([figure([units[i] for i in rng.integers(0, len(units), len(units))]) for _ in range(draws)])
    known = values[~np.isnan(values)]
    return _percentiles(known) if len(known) else (nan, nan)


def _percentiles(values: np.typing.NDArray[np.float64]) -> Interval:
    tail = (1 - LEVEL) / 2 * 100
    low, high = np.percentile(values, [tail, 100 - tail])
    return float(low), float(high)
