"""Bayes factors: how much likelier the accuracies are if a condition matters than if it does not.

Two levels: the JZS Bayes factor of a t-test, from `pingouin` (extra `[evaluation]`), as in the paper's kind of analysis. More levels:
the BIC approximation exp((BIC0 - BIC1) / 2) of an analysis of variance (Wagenmakers 2007, Psychon. Bull. Rev. 14:779), for levels
within participants with n = participants x (levels - 1) independent observations (Masson 2011, Behav. Res. Methods 43:679).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import exp, isfinite, log, nan

import numpy as np

from egotouch_sdk.errors import MissingExtraError

#: Accuracy per participant, by level.
Levels = Mapping[str, Mapping[str, float]]
#: exp() of more than this is beyond any use.
_MOST = 100.0


@dataclass(frozen=True, slots=True)
class BayesFactor:
    """The factor (above 1: the condition matters), how it was found, and how many participants and levels went in; nan for too few."""

    factor: float
    method: str
    participants: int
    levels: int


def bayes_factor(levels: Levels) -> BayesFactor:
    """Bayes factor of accuracies: between participants where each has but one level, else within them.

    Within participants, those who miss a level are left out. Raises `MissingExtraError` for two levels without the extra.
    """
    everyone = [number for row in levels.values() for number in row]
    if len(set(everyone)) < len(everyone):
        complete = sorted(set.intersection(*(set(row) for row in levels.values())))
        table = np.array([[row[number] for row in levels.values()] for number in complete]).reshape(len(complete), len(levels))
        table = table[np.isfinite(table).all(axis=1)]
        count = len(table)
        if count < 2 or len(levels) < 2:
            return BayesFactor(nan, "too few", count, len(levels))
        if len(levels) == 2:
            return BayesFactor(_paired(table[:, 0] - table[:, 1]), "JZS, paired", count, 2)
        return BayesFactor(within_factor(table), "BIC, within participants", count, len(levels))
    samples = [[value for value in row.values() if isfinite(value)] for row in levels.values()]
    samples = [sample for sample in samples if sample]
    count = sum(map(len, samples))
    if len(samples) < 2 or count < len(samples) + 1:
        return BayesFactor(nan, "too few", count, len(samples))
    if len(samples) == 2 and min(map(len, samples)) > 1:
        return BayesFactor(_two_groups(*samples), "JZS, two groups", count, 2)
    return BayesFactor(between_factor(samples), "BIC, between participants", count, len(samples))


def between_factor(samples: Sequence[Sequence[float]]) -> float:
    """BIC approximation for groups of participants against one mean for all."""
    values = np.concatenate([np.asarray(sample, float) for sample in samples])
    total = float(((values - values.mean()) ** 2).sum())
    error = float(sum(((np.asarray(sample) - np.mean(sample)) ** 2).sum() for sample in samples))
    return _from_squares(error, total, len(values), len(samples) - 1)


def within_factor(table: np.typing.NDArray[np.float64]) -> float:
    """BIC approximation for levels (columns) within participants (rows) against participants alone."""
    people, levels = table.shape
    residual = table - table.mean(axis=1, keepdims=True) - table.mean(axis=0, keepdims=True) + table.mean()
    effect = people * float(((table.mean(axis=0) - table.mean()) ** 2).sum())
    error = float((residual**2).sum())
    return _from_squares(error, error + effect, people * (levels - 1), levels - 1)


def _from_squares(with_effect: float, without: float, observations: int, parameters: int) -> float:
    if without <= 0:
        return nan
    if with_effect <= 0:
        return exp(_MOST)
    difference = observations * log(without / with_effect) - parameters * log(observations)
    return exp(min(difference / 2, _MOST))


def _paired(differences: np.typing.NDArray[np.float64]) -> float:
    spread = float(differences.std(ddof=1))
    if spread == 0:
        return nan if differences.any() else _jzs(0.0, len(differences))
    return _jzs(float(differences.mean()) / spread * len(differences) ** 0.5, len(differences))


def _two_groups(first: Sequence[float], second: Sequence[float]) -> float:
    nx, ny = len(first), len(second)
    pooled = ((nx - 1) * np.var(first, ddof=1) + (ny - 1) * np.var(second, ddof=1)) / (nx + ny - 2)
    gap = float(np.mean(first) - np.mean(second))
    if pooled == 0:
        return nan if gap else _jzs(0.0, nx, ny)
    return _jzs(gap / float(pooled * (1 / nx + 1 / ny)) ** 0.5, nx, ny)


def _jzs(t: float, nx: int, ny: int | None = None) -> float:
    try:
        from pingouin import bayesfactor_ttest
    except ImportError as error:
        raise MissingExtraError("a Bayes factor of two levels", "evaluation") from error
    return float(bayesfactor_ttest(t, nx, ny, paired=ny is None))
