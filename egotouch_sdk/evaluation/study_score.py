"""A study's figures from the scores of its rounds: for everybody, for each participant, and for groups. No I/O, no clock."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import isnan, nan

import numpy as np

from egotouch_sdk.evaluation.confusion import Confusion, Matches, share
from egotouch_sdk.evaluation.metrics import auroc, calibration_error, force_scores
from egotouch_sdk.evaluation.round_score import HARD_N, SHIFTS, SIDES, RoundScore
from egotouch_sdk.evaluation.round_truth import ORDER
from egotouch_sdk.evaluation.touches import TOLERANCES, Candidates, average_precision

Figures = dict[str, float]

#: Edges of the hover heights in mm between which rejection is told; a last bin is beyond.
HEIGHTS_MM = (0.0, 1.0, 2.0, 5.0, 10.0)


def frame_figures(scores: Sequence[RoundScore]) -> dict[str, Figures]:
    """Accuracy, TPR and FPR (0..1) by side, with the truth as it is, one frame later, and after the hard alignment."""
    rows: dict[str, Figures] = {}
    for side in SIDES:
        for shift in SHIFTS:
            rows[f"{side} +{shift}" if shift else side] = _rates(sum((score.frames[side, shift] for score in scores), Confusion()))
        rows[f"{side} aligned"] = _rates(sum((score.aligned[side] for score in scores), Confusion()))
    return rows


def _rates(counts: Confusion) -> Figures:
    return {"accuracy": counts.accuracy, "tpr": counts.tpr, "fpr": counts.fpr}


def figures(scores: Sequence[RoundScore]) -> Figures:
    """Every figure of some rounds taken together, by name; nan where there is nothing to measure.

    Shares are 0..1, forces newtons, times ms. Frame figures are of the live side (median and state machine) against the truth of the
    same frame; `shifted_*` with the truth one frame later, as in the paper; `aligned_*` after the hard alignment; `auroc`, `auprc` and
    `ece` of the model's own probability.
    """
    live, later = (sum((score.frames["live", shift] for score in scores), Confusion()) for shift in SHIFTS)
    aligned = sum((score.aligned["live"] for score in scores), Confusion())
    touch = np.concatenate([score.touch for score in scores])
    probability = np.concatenate([score.probability for score in scores])
    both = bool(touch.any() and not touch.all())
    touches = sum(score.touches for score in scores)
    result = {
        "accuracy": live.accuracy,
        "tpr": live.tpr,
        "fpr": live.fpr,
        "shifted_accuracy": later.accuracy,
        "shifted_tpr": later.tpr,
        "shifted_fpr": later.fpr,
        "aligned_accuracy": aligned.accuracy,
        "aligned_tpr": aligned.tpr,
        "aligned_fpr": aligned.fpr,
        "auroc": auroc(touch, probability) if both else nan,
        "auprc": average_precision(touch, probability, int(touch.sum())),
        "ece": calibration_error(touch, probability) if len(touch) else nan,
        "click_accuracy": share(sum(score.clicks for score in scores), touches),
        "chatter_per_touch": share(sum(score.extra for score in scores), touches),
        "merged_share": share(sum(score.merged for score in scores), touches),
        "false_touches_per_minute": share(sum(score.false_touches for score in scores), sum(score.seconds for score in scores) / 60),
    }
    return {**result, **_onset_figures(scores), **_force_figures(scores), **_hover_figures(scores), **_drag_figures(scores)}


def _onset_figures(scores: Sequence[RoundScore]) -> Figures:
    result: Figures = {}
    offered = Candidates.join([score.candidates for score in scores])
    for tolerance in TOLERANCES:
        for shift in SHIFTS:
            suffix = f"{tolerance}_shifted" if shift else f"{tolerance}"
            result[f"onset_f1_{suffix}"] = sum((score.onsets[tolerance, shift] for score in scores), Matches()).f1
            result[f"offset_f1_{suffix}"] = sum((score.offsets[tolerance, shift] for score in scores), Matches()).f1
        result[f"event_ap_{tolerance}"] = offered.average_precision(tolerance)
    for name in ("onset", "offset"):
        delays = np.concatenate([getattr(score, f"{name}_delay_ms") for score in scores])
        result[f"{name}_delay_ms_median"] = float(np.median(delays)) if len(delays) else nan
        result[f"{name}_delay_ms_p95"] = float(np.percentile(delays, 95)) if len(delays) else nan
        result[f"{name}_jitter_ms"] = float(delays.std()) if len(delays) else nan
    return result


def _force_figures(scores: Sequence[RoundScore]) -> Figures:
    true_n, told_n = (np.concatenate([getattr(score, name) for score in scores]) for name in ("true_n", "told_n"))
    pressed = np.concatenate([score.touch for score in scores]) & (true_n > 0)
    true_n, told_n = true_n[pressed], told_n[pressed]
    peaks_n = np.concatenate([score.peaks_n for score in scores])
    peaks_n = peaks_n[np.isfinite(peaks_n).all(axis=1)]
    """Force over touching frames whose force was measured."""
    names = ("mae_n", "mae_range_percent", "mae_relative_percent", "spearman", "constant_mae_n")
    forces = force_scores(true_n, told_n) if len(true_n) else None
    return {
        **{f"force_{name}": nan if forces is None else getattr(forces, name) for name in names},
        "soft_hard_frames": _mean((true_n >= HARD_N) == (told_n >= HARD_N)),
        "soft_hard_touches": _mean((peaks_n[:, 0] >= HARD_N) == (peaks_n[:, 1] >= HARD_N)),
    }


def height_names() -> list[str]:
    """Names of the hover heights, lowest first, for example `hover_1_2_mm`."""
    return [f"hover_{low:g}_{high:g}_mm" for low, high in pairwise(HEIGHTS_MM)] + [f"hover_over_{HEIGHTS_MM[-1]:g}_mm"]


def _hover_figures(scores: Sequence[RoundScore]) -> Figures:
    """Share of hovering frames that the live side calls hovering: of all, of those in rounds of hovers, and by height."""
    hover = ~np.concatenate([score.touch for score in scores])
    rejected = ~np.concatenate([score.live for score in scores])[hover]
    height_mm = np.concatenate([score.hover_mm for score in scores])[hover]
    asked = np.concatenate([np.full(len(score.touch), score.is_hover) for score in scores])[hover]
    index = np.where(np.isnan(height_mm), -1, np.searchsorted(HEIGHTS_MM[1:], height_mm, side="right"))
    by_height = {name: _mean(rejected[index == number]) for number, name in enumerate(height_names())}
    return {"hover_rejection": _mean(rejected), "hover_round_rejection": _mean(rejected[asked]), **by_height}


def _drag_figures(scores: Sequence[RoundScore]) -> Figures:
    drags = [score for score in scores if score.is_drag]
    return {"drag_dropouts_per_s": share(sum(score.extra for score in drags), sum(score.contact_s for score in drags))}


def _mean(right: np.typing.NDArray[np.bool_]) -> float:
    return float(right.mean()) if right.size else nan


def by_participant(scores: Sequence[RoundScore]) -> dict[str, list[RoundScore]]:
    """The rounds of each participant, in order of their names."""
    return {name: [score for score in scores if score.participant == name] for name in sorted({score.participant for score in scores})}


def accuracy(scores: Sequence[RoundScore]) -> float:
    """Frame accuracy of the live side, 0..1."""
    return sum((score.frames["live", 0] for score in scores), Confusion()).accuracy


@dataclass(frozen=True, slots=True)
class Spread:
    """A figure over participants: mean and standard deviation (over n - 1) of those that have it, and how many these are."""

    mean: float
    std: float
    count: int

    @classmethod
    def of(cls, values: Iterable[float]) -> Spread:
        """Spread of some values, nan left out."""
        known = [value for value in values if not isnan(value)]
        return cls(float(np.mean(known)) if known else nan, float(np.std(known, ddof=1)) if len(known) > 1 else nan, len(known))


@dataclass(frozen=True, slots=True)
class Group:
    """The rounds with one value of a condition: their figures, and the accuracy of each of their participants."""

    name: str
    rounds: int
    accuracies: dict[str, float]
    figures: Figures

    @property
    def accuracy(self) -> Spread:
        """Spread of the accuracy over participants."""
        return Spread.of(self.accuracies.values())


def groups(scores: Sequence[RoundScore], condition: str) -> list[Group]:
    """The groups of a condition in their order; rounds without the condition are left out."""
    result = []
    names = {score.conditions[condition] for score in scores if condition in score.conditions}
    for name in sorted(names, key=lambda name: (ORDER.index(name) if name in ORDER else len(ORDER), name)):
        part = [score for score in scores if score.conditions.get(condition) == name]
        each = {participant: accuracy(rounds) for participant, rounds in by_participant(part).items()}
        result.append(Group(name, len(part), each, figures(part)))
    return result


def worst(parts: Sequence[Group]) -> Group | None:
    """The group with the lowest mean accuracy over participants; None for fewer than two groups."""
    known = [part for part in parts if not isnan(part.accuracy.mean)]
    return min(known, key=lambda part: part.accuracy.mean) if len(known) > 1 else None
