"""How a report names its figures and writes its numbers."""

from __future__ import annotations

from collections.abc import Mapping
from math import isnan

#: Figures by heading: (name, words, unit). Units: `%` of a share, `N`, `ms`, `pct` for what is in percent already, `` for plain numbers.
FIGURES: Mapping[str, tuple[tuple[str, str, str], ...]] = {
    "Frames": (
        ("accuracy", "Frame accuracy", "%"),
        ("tpr", "True positive rate", "%"),
        ("fpr", "False positive rate", "%"),
        ("shifted_accuracy", "Frame accuracy, truth one frame later", "%"),
        ("shifted_tpr", "True positive rate, truth one frame later", "%"),
        ("shifted_fpr", "False positive rate, truth one frame later", "%"),
        ("aligned_accuracy", "Frame accuracy, aligned within 4 frames", "%"),
        ("aligned_tpr", "True positive rate, aligned", "%"),
        ("aligned_fpr", "False positive rate, aligned", "%"),
        ("auroc", "AUROC of the probability", ""),
        ("auprc", "AUPRC of the probability", ""),
        ("ece", "Expected calibration error", ""),
    ),
    "Touches": (
        ("click_accuracy", "Click accuracy", "%"),
        ("onset_f1_0", "Onset F1, same frame", ""),
        ("onset_f1_0_shifted", "Onset F1, same frame, truth one frame later", ""),
        ("onset_f1_1", "Onset F1, 1 frame", ""),
        ("onset_f1_2", "Onset F1, 2 frames", ""),
        ("onset_f1_4", "Onset F1, 4 frames", ""),
        ("offset_f1_0", "Offset F1, same frame", ""),
        ("offset_f1_0_shifted", "Offset F1, same frame, truth one frame later", ""),
        ("offset_f1_1", "Offset F1, 1 frame", ""),
        ("offset_f1_2", "Offset F1, 2 frames", ""),
        ("offset_f1_4", "Offset F1, 4 frames", ""),
        ("event_ap_0", "Onset AP, same frame", ""),
        ("event_ap_1", "Onset AP, 1 frame", ""),
        ("event_ap_2", "Onset AP, 2 frames", ""),
        ("event_ap_4", "Onset AP, 4 frames", ""),
        ("false_touches_per_minute", "False touches per minute", ""),
        ("merged_share", "True touches told as one with another", "%"),
        ("chatter_per_touch", "Chatter: extra touches per true touch", ""),
        ("drag_dropouts_per_s", "Drop-outs per second of dragging", ""),
    ),
    "Time": (
        ("onset_delay_ms_median", "Onset delay, median", "ms"),
        ("onset_delay_ms_p95", "Onset delay, 95th percentile", "ms"),
        ("onset_jitter_ms", "Onset jitter (standard deviation)", "ms"),
        ("offset_delay_ms_median", "Offset delay, median", "ms"),
        ("offset_delay_ms_p95", "Offset delay, 95th percentile", "ms"),
        ("offset_jitter_ms", "Offset jitter (standard deviation)", "ms"),
    ),
    "Force": (
        ("force_mae_n", "Mean absolute error", "N"),
        ("force_mae_range_percent", "Error in % of the 3.5 N range", "pct"),
        ("force_mae_relative_percent", "Error relative to the true force", "pct"),
        ("force_constant_mae_n", "Error of always answering the median force", "N"),
        ("force_spearman", "Rank correlation", ""),
        ("soft_hard_frames", "Soft or hard at 1 N, frames", "%"),
        ("soft_hard_touches", "Soft or hard at 1 N, peak of each touch", "%"),
    ),
    "Hover": (
        ("hover_rejection", "Hovering frames told as hover, all", "%"),
        ("hover_round_rejection", "the same in rounds of hovers", "%"),
        ("hover_0_1_mm", "from 0 to 1 mm", "%"),
        ("hover_1_2_mm", "from 1 to 2 mm", "%"),
        ("hover_2_5_mm", "from 2 to 5 mm", "%"),
        ("hover_5_10_mm", "from 5 to 10 mm", "%"),
        ("hover_over_10_mm", "above 10 mm", "%"),
    ),
}
UNITS = {name: unit for rows in FIGURES.values() for name, _, unit in rows}

NOTHING = "–"


def number(value: float, unit: str) -> str:
    """A figure as text, a dash for nan."""
    if isnan(value):
        return NOTHING
    return {"%": f"{value * 100:.1f} %", "pct": f"{value:.1f} %", "ms": f"{value:.0f} ms", "N": f"{value:.2f} N"}.get(unit, f"{value:.3f}")


def with_spread(mean: float, std: float, unit: str) -> str:
    """Mean with its standard deviation."""
    return number(mean, unit) if isnan(std) else f"{_bare(mean, unit)} ± {number(std, unit)}"


def interval(low: float, high: float, unit: str) -> str:
    """An interval, a dash where there is none."""
    return NOTHING if isnan(low) or isnan(high) else f"{_bare(low, unit)} to {number(high, unit)}"


def _bare(value: float, unit: str) -> str:
    return number(value, unit).partition(" ")[0]


def words(name: str) -> str:
    """A value of a condition for people: `back_of_hand` becomes `back of hand`."""
    return name.replace("_", " ")
