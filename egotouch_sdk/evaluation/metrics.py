"""Scores of touch probabilities and forces against labels; plain numpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import FrameError
from egotouch_sdk.observation import FORCE_MAX_N

Floats = npt.NDArray[np.floating]
Bools = npt.NDArray[np.bool_]


def ranks(values: Floats) -> npt.NDArray[np.float64]:
    """Ranks from 1, ties sharing their mean rank."""
    _, inverse, counts = np.unique(values, return_inverse=True, return_counts=True)
    ends = np.cumsum(counts)
    return np.asarray((ends - (counts - 1) / 2)[inverse], np.float64)


def auroc(touch: Bools, score: Floats) -> float:
    """Area under the ROC curve: the chance that a touch scores above a hover, ties counting half. Needs both classes."""
    positives = int(touch.sum())
    negatives = touch.size - positives
    if not positives or not negatives:
        raise FrameError("AUROC needs at least one touch and one hover")
    rank_sum = float(ranks(score)[touch].sum())
    return (rank_sum - positives * (positives + 1) / 2) / (positives * negatives)


def spearman(first: Floats, second: Floats) -> float:
    """Spearman's rank correlation, -1..1; nan with fewer than three values or a constant side."""
    if first.size < 3 or np.ptp(first) == 0 or np.ptp(second) == 0:
        return float("nan")
    return float(np.corrcoef(ranks(first), ranks(second))[0, 1])


@dataclass(frozen=True, slots=True)
class TouchScores:
    """Decisions at one threshold: shares 0..1. `true_positive_rate` is over touches, `false_positive_rate` over hovers."""

    auroc: float
    accuracy: float
    true_positive_rate: float
    false_positive_rate: float


def touch_scores(touch: Bools, probability: Floats, threshold: float) -> TouchScores:
    """Score touch probabilities (N,) against labels (N,), calling a touch at or above the threshold."""
    called = probability >= threshold
    return TouchScores(
        auroc=auroc(touch, probability),
        accuracy=float((called == touch).mean()),
        true_positive_rate=float(called[touch].mean()),
        false_positive_rate=float(called[~touch].mean()),
    )


@dataclass(frozen=True, slots=True)
class ForceScores:
    """Force error on touches: mean absolute error in newtons, in % of the 3.5 N range, relative in %, and rank correlation.

    `constant_mae_n` is the error of always answering the median force, the bar that a useful model must pass.
    """

    mae_n: float
    mae_range_percent: float
    mae_relative_percent: float
    spearman: float
    constant_mae_n: float


def force_scores(true_n: Floats, estimated_n: Floats) -> ForceScores:
    """Score forces (N,) in newtons of true touches; all `true_n` above 0."""
    error = np.abs(estimated_n - true_n)
    return ForceScores(
        mae_n=float(error.mean()),
        mae_range_percent=float(error.mean() / FORCE_MAX_N * 100),
        mae_relative_percent=float((error / np.maximum(true_n, 1e-6)).mean() * 100),
        spearman=spearman(true_n, estimated_n),
        constant_mae_n=float(np.abs(true_n - np.median(true_n)).mean()),
    )


def calibration_error(touch: Bools, probability: Floats, bins: int = 10) -> float:
    """Expected calibration error: mean gap between probability and share of touches over equal-width bins, weighted by size."""
    index = np.minimum((probability * bins).astype(int), bins - 1)
    gaps = [abs(float(touch[index == b].mean() - probability[index == b].mean())) * float((index == b).mean()) for b in np.unique(index)]
    return float(sum(gaps))
