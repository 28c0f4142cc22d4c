"""Scores of a network on held-out rendered patches, whole and by condition."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from egotouch_sdk.evaluation.metrics import calibration_error, force_scores, touch_scores
from egotouch_sdk.training.shards import PatchLabel

#: Hover heights told apart in the report, in millimetres, and touch forces, in newtons.
HOVER_BINS_MM = ((0.0, 3.0), (3.0, 6.0), (6.0, 12.0), (12.0, 1e9))
FORCE_BINS_N = ((0.0, 0.5), (0.5, 1.5), (1.5, 1e9))
#: Conditions with fewer pictures than this are left out.
MIN_PICTURES = 20


def held_out_report(
    labels: Sequence[PatchLabel], probability: npt.NDArray[np.floating], force_n: npt.NDArray[np.floating], threshold: float
) -> dict[str, Any]:
    """All scores as JSON-ready numbers; shares are 0..1. One label per picture, repeated for repeated views."""
    touch = np.array([label.touch for label in labels])
    true_n = np.array([label.force_n for label in labels])
    hover_mm = np.array([label.hover_mm for label in labels])
    called = probability >= threshold
    overall, force = touch_scores(touch, probability, threshold), force_scores(true_n[touch], force_n[touch])
    report: dict[str, Any] = {
        "pictures": len(labels),
        "auroc": _round(overall.auroc),
        "accuracy": _round(overall.accuracy),
        "true_positive_rate": _round(overall.true_positive_rate),
        "false_positive_rate": _round(overall.false_positive_rate),
        "calibration_error": _round(calibration_error(touch, probability)),
        "force_mae_n": _round(force.mae_n),
        "force_mae_range_percent": _round(force.mae_range_percent),
        "force_mae_constant_n": _round(force.constant_mae_n),
        "force_spearman": _round(force.spearman),
        "false_positive_rate_by_hover_mm": _by_bin(hover_mm, called, ~touch, HOVER_BINS_MM),
        "true_positive_rate_by_force_n": _by_bin(true_n, called, touch, FORCE_BINS_N),
    }
    right = called == touch
    keys: dict[str, Callable[[PatchLabel], str]] = {
        "finger": lambda label: label.finger,
        "place": lambda label: label.place,
        "fitzpatrick": lambda label: str(label.fitzpatrick),
    }
    for name, key in keys.items():
        groups = np.array([key(label) for label in labels])
        counted = {str(g): _round(right[groups == g].mean()) for g in np.unique(groups) if (groups == g).sum() >= MIN_PICTURES}
        report[f"accuracy_by_{name}"] = counted
    return report


def coverage(labels: Sequence[PatchLabel], force_n: npt.NDArray[np.floating], sigma_n: npt.NDArray[np.floating]) -> float:
    """Share of touches whose force lies within one standard error of the estimate; .68 when the errors are normal and honest."""
    touch = np.array([label.touch for label in labels])
    error_n = np.abs(force_n - np.array([label.force_n for label in labels]))
    return _round((error_n <= sigma_n)[touch].mean())


def _by_bin(
    value: npt.NDArray[np.floating], called: npt.NDArray[np.bool_], chosen: npt.NDArray[np.bool_], bins: Sequence[tuple[float, float]]
) -> dict[str, float]:
    rates = {}
    for low, high in bins:
        inside = chosen & (value >= low) & (value < high)
        if inside.sum() >= MIN_PICTURES:
            rates[f"{low:g}-{high:g}" if high < 1e6 else f"{low:g}+"] = _round(called[inside].mean())
    return rates


def _round(value: float) -> float:
    return round(float(value), 4)
