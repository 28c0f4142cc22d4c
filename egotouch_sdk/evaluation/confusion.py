"""Right and wrong calls, counted; counts add up over rounds."""

from __future__ import annotations

from dataclasses import astuple, dataclass
from math import nan

import numpy as np
import numpy.typing as npt

Bools = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Confusion:
    """How many touches were called touch (`tp`) or hover (`fn`), and how many hovers touch (`fp`) or hover (`tn`)."""

    tp: int = 0
    fn: int = 0
    fp: int = 0
    tn: int = 0

    @classmethod
    def of(cls, touch: Bools, called: Bools) -> Confusion:
        """Count frames (N,) of truth against calls."""
        return cls(int((touch & called).sum()), int((touch & ~called).sum()), int((~touch & called).sum()), int((~touch & ~called).sum()))

    def __add__(self, other: Confusion) -> Confusion:
        return Confusion(*(a + b for a, b in zip(astuple(self), astuple(other), strict=True)))

    @property
    def total(self) -> int:
        """All that was counted."""
        return self.tp + self.fn + self.fp + self.tn

    @property
    def accuracy(self) -> float:
        """Share that was called right, 0..1; nan where nothing was counted."""
        return share(self.tp + self.tn, self.total)

    @property
    def tpr(self) -> float:
        """Share of touches that were called touch."""
        return share(self.tp, self.tp + self.fn)

    @property
    def fpr(self) -> float:
        """Share of hovers that were called touch."""
        return share(self.fp, self.fp + self.tn)


@dataclass(frozen=True, slots=True)
class Matches:
    """Events of the truth that were found, those that were missed, and those told that never happened."""

    found: int = 0
    missed: int = 0
    false: int = 0

    def __add__(self, other: Matches) -> Matches:
        return Matches(self.found + other.found, self.missed + other.missed, self.false + other.false)

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall, 0..1; nan where there was nothing to find and nothing told."""
        return share(2 * self.found, 2 * self.found + self.missed + self.false)


def share(part: float, whole: float) -> float:
    """`part` of `whole`, nan of nothing."""
    return part / whole if whole else nan
