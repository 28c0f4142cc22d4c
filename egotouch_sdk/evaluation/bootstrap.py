"""Confidence intervals by drawing whole participants, recordings or stretches of frames again, never single frames."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import nan
from typing import TypeVar

import numpy as np
import numpy.typing as npt

Interval = tuple[float, float]
Indices = npt.NDArray[np.int64]
_Unit = TypeVar("_Unit")

#: Draws behind an interval, and its level (our choice: the usual ones).
DRAWS, LEVEL = 2000, 0.95
#: Frames that are drawn together within a recording: half a second at 30 fps (our choice).
BLOCK = 15


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


def interval_of_recordings(
    lengths: Sequence[int], figure: Callable[[Indices], float], block: int = BLOCK, draws: int = DRAWS, seed: int = 0
) -> Interval:
    """Percentile interval of a figure of rows that come in order of recordings of these lengths.

    Each draw takes as many recordings again as there are, and from each as many rows as it has, in stretches of `block` rows that lie
    together: rows one after another are near copies. `figure` gets the indices of the drawn rows; draws without it (nan) are left out.
    """
    rng, firsts = np.random.default_rng(seed), np.concatenate([[0], np.cumsum(lengths)])
    values = []
    for _ in range(draws):
        drawn = rng.integers(0, len(lengths), len(lengths))
        values.append(figure(np.concatenate([firsts[number] + _stretches(lengths[number], block, rng) for number in drawn])))
    known = np.array(values)[~np.isnan(values)]
    return _percentiles(known) if len(known) else (nan, nan)


def _stretches(length: int, block: int, rng: np.random.Generator) -> Indices:
    block = min(block, max(length // 5, 1))
    starts = rng.integers(0, length - block + 1, -(-length // block))
    return np.asarray((starts[:, None] + np.arange(block)).ravel()[:length], np.int64)


def _percentiles(values: npt.NDArray[np.float64]) -> Interval:
    tail = (1 - LEVEL) / 2 * 100
    low, high = np.percentile(values, [tail, 100 - tail])
    return float(low), float(high)
